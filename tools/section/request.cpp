#include "tools/section/request.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "symbolic/case/limits.hpp"
#include "symbolic/expression/decimal.hpp"
#include "symbolic/expression/expression.hpp"
#include "tools/cli/errors.hpp"

namespace casimir::tools {
namespace {

Text option_text(const std::string& option, const std::string& value) {
  return {value, {option, 1, 1}, value};
}

double real_constant(const Text& text, const Limits& limits) {
  const std::optional<GiNaC::numeric> value =
      real_decimal(parse_constant(text, limits), limits.bits);
  if (!value) throw text.error("expected a real number");
  return value->to_double();
}

class Reader {
 public:
  Reader(const CaseFile& file, const Model& model, const SectionOptions& options,
         bool for_picture = true)
      : file_(file.section), model_(model), options_(options), for_picture_(for_picture) {}

  SectionRequest read() {
    read_plane();
    read_pair();
    read_labels();
    read_level();
    return std::move(request_);
  }

  SectionRequest read_without_pair() {
    read_plane();
    read_level();
    if (request_.energy && !(model_.hamiltonian && model_.poisson))
      throw UsageError(
          fmt::format("'{}' is given by its equations and has no energy", model_.name));
    return std::move(request_);
  }

 private:
  void read_plane() {
    if (options_.plane) {
      const Text text = option_text("--plane", *options_.plane);
      if (text.value.find('=') != std::string::npos) {
        const Identity level = model_.parse_identity(text);
        request_.plane = {level.left - level.right, text.value};
      } else {
        request_.plane = {model_.parse(text), text.value};
      }
    } else if (model_.section) {
      if (file_) request_.plane = {model_.section->function, file_->function.value};
      request_.upwards = model_.section->upwards;
    } else {
      throw UsageError(fmt::format("'{}' has no [section]: give the plane by --plane EXPR{}",
                                   model_.name,
                                   for_picture_ ? " and what is plotted by --pair U V" : ""));
    }
    if (options_.direction) request_.upwards = *options_.direction == "up";
  }

  void read_pair() {
    for (const std::string& text : options_.pair)
      request_.pair.push_back({model_.parse(option_text("--pair", text)), text});
    const bool of_file = request_.pair.empty() && file_ && model_.section;
    for (std::size_t i = 0; of_file && i < model_.section->plot.size(); ++i)
      request_.pair.push_back({model_.section->plot[i], file_->plot.at(i).value});
    if (request_.pair.size() == 2) return;
    const std::string message = fmt::format(
        "a section is plotted by two functions, and there are {}", request_.pair.size());
    if (options_.pair.empty() && file_ && !file_->plot.empty())
      throw file_->plot.front().error(message);
    throw UsageError(message + ": give them by --pair U V");
  }

  void read_labels() {
    request_.labels = options_.labels;
    if (request_.labels.empty() && options_.pair.empty() && file_)
      for (const Text& text : file_->labels) request_.labels.push_back(text.value);
    if (request_.labels.empty() || request_.labels.size() == 2) return;
    if (options_.labels.empty()) throw file_->labels.front().error("'labels' must be two");
    throw UsageError("--labels needs two");
  }

  void read_level() {
    if (options_.energy)
      request_.energy = real_constant(option_text("--energy", *options_.energy), model_.limits);
    else if (file_ && file_->energy)
      request_.energy = real_constant(*file_->energy, model_.limits);
    if (file_)
      for (const auto& [name, value] : file_->casimirs)
        add_casimir(name, real_constant(value, model_.limits));
    for (const std::string& text : options_.casimirs) {
      const std::size_t equals = text.find('=');
      if (equals == std::string::npos)
        throw UsageError(fmt::format("--casimir '{}': expected NAME=VALUE", printable(text)));
      const Text value{
          text.substr(equals + 1), {"--casimir", 1, static_cast<int>(equals) + 2}, text};
      add_casimir({text.substr(0, equals), {"--casimir", 1, 1}, text},
                  real_constant(value, model_.limits));
    }
  }

  void add_casimir(const Text& name, double value) {
    const std::vector<std::string> known = names_of(model_.casimirs);
    if (std::ranges::count(known, name.value) == 0) {
      throw name.error(
          fmt::format("the case names no Casimir function '{}'", printable(name.value)), 0,
          known.empty() ? "it names none at all" : suggest_or_list(name.value, known));
    }
    request_.casimirs.emplace_back(name.value, value);
  }

  const std::optional<SectionText>& file_;
  const Model& model_;
  const SectionOptions& options_;
  bool for_picture_;
  SectionRequest request_;
};

}  // namespace

SectionRequest section_request(const CaseFile& file, const Model& model,
                               const SectionOptions& options) {
  require_energy_level(model);
  return Reader(file, model, options).read();
}

SectionRequest plane_request(const CaseFile& file, const Model& model,
                             const SectionOptions& options) {
  return Reader(file, model, options, false).read_without_pair();
}

}  // namespace casimir::tools
