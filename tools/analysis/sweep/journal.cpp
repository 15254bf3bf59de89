#include "tools/analysis/sweep/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sodium.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>

#include "codegen/compile.hpp"
#include "symbolic/error.hpp"
#include "tools/analysis/error.hpp"

namespace casimir {
namespace {

constexpr const char* kFirstLine = "casimir sweep 1,";

std::string hex(const std::string& text, std::size_t bytes) {
  std::vector<unsigned char> hash(bytes);
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(text.data()),
                     text.size(), nullptr, 0);
  std::string result;
  for (const unsigned char byte : hash) result += fmt::format("{:02x}", byte);
  return result;
}

/// 16 bytes are the least that the library gives; four hexadecimal pairs of them do for a line.
std::string checksum(const std::string& line) { return hex(line, 16).substr(0, 8); }

std::string line_of(std::size_t point, const PointResult& result) {
  std::string line = fmt::format("{},{}", point, static_cast<int>(result.status));
  for (const double x : result.values) line += fmt::format(",{:.17g}", x);
  return line + "," + checksum(line) + "\n";
}

template <class Number>
bool read_number(const std::string& text, Number& value) {
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  return problem == std::errc{} && end == text.data() + text.size();
}

/// The result in a line, and its point; none if the line is damaged.
std::optional<std::pair<std::size_t, PointResult>> result_in(const std::string& line,
                                                             std::size_t columns) {
  const std::size_t last = line.rfind(',');
  if (last == std::string::npos || checksum(line.substr(0, last)) != line.substr(last + 1))
    return std::nullopt;
  std::vector<std::string> fields;
  std::istringstream stream(line.substr(0, last));
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  std::size_t point = 0;
  int status = 0;
  if (fields.size() != columns + 2 || !read_number(fields[0], point) ||
      !read_number(fields[1], status))
    return std::nullopt;
  PointResult result{static_cast<Status>(status), {}};
  for (std::size_t i = 2; i < fields.size(); ++i) {
    double x = 0;
    if (!read_number(fields[i], x)) return std::nullopt;
    result.values.push_back(x);
  }
  return std::pair{point, result};
}

}  // namespace

std::string digest(const std::string& text) { return hex(text, 16); }

Journal::Journal(const std::string& output, const std::string& fingerprint, std::size_t columns,
                 bool restart)
    : path_(output + ".journal") {
  file_ = open(path_.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
  if (file_ < 0)
    throw EnvironmentError(
        fmt::format("cannot write '{}': {}", printable(path_, 200), std::strerror(errno)));
  if (flock(file_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
    close(file_);
    throw EnvironmentError(
        fmt::format("'{}' is being written by another sweep", printable(path_, 200)));
  }
  if (restart && ftruncate(file_, 0) != 0)
    throw EnvironmentError(
        fmt::format("cannot empty '{}': {}", printable(path_, 200), std::strerror(errno)));
  try {
    read(fingerprint, columns);
  } catch (...) {
    close(file_);
    throw;
  }
}

void Journal::read(const std::string& fingerprint, std::size_t columns) {
  std::ifstream stream(path_, std::ios::binary);
  std::string line;
  if (!std::getline(stream, line)) {
    write(kFirstLine + fingerprint + "\n");
    return;
  }
  // A first line that a kill has torn has nothing after it.
  const std::string own = kFirstLine + fingerprint;
  if (stream.eof() && own.starts_with(line)) {
    if (ftruncate(file_, 0) == 0) write(own + "\n");
    return;
  }
  if (line != own)
    throw RequestError(fmt::format(
        "'{0}' holds the points of another sweep (another case, grid, method or version)\n  hint: "
        "another file, or a restart that throws them away",
        printable(path_, 200)));
  bool torn = false;
  while (std::getline(stream, line)) {
    torn = stream.eof();
    if (auto result = result_in(line, columns)) done_.insert(std::move(*result));
  }
  if (torn) write("\n");  // so that the next line is not joined to it
}

Journal::~Journal() {
  if (file_ >= 0 && done_.empty()) remove();  // what failed at once leaves nothing behind
  if (file_ >= 0) close(file_);
}

void Journal::write(const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = ::write(file_, text.data() + written, text.size() - written);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0)
      throw EnvironmentError(
          fmt::format("cannot write all of '{}': {}", printable(path_, 200), std::strerror(errno)));
    written += static_cast<std::size_t>(count);
  }
  fdatasync(file_);
}

void Journal::append(const std::map<std::size_t, PointResult>& results) {
  std::string text;
  for (const auto& [point, result] : results) text += line_of(point, result);
  write(text);
  done_.insert(results.begin(), results.end());
}

void Journal::remove() { unlink(path_.c_str()); }

}  // namespace casimir
