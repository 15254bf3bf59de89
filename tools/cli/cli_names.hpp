#pragma once

// The library of the command line, for headers that only name it: its own header takes a compiler
// four seconds.
namespace CLI {
class App;
class Option;
}  // namespace CLI
