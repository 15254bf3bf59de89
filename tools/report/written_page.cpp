#include "tools/report/written_page.hpp"

#include <array>

namespace casimir::tools {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::array kTexts{&IndexEntry::case_name,   &IndexEntry::book,   &IndexEntry::title,
                            &IndexEntry::phase_space, &IndexEntry::tags,   &IndexEntry::thumbnail,
                            &IndexEntry::link,        &IndexEntry::claims, &IndexEntry::fastest,
                            &IndexEntry::problem};

Json to_json(const std::optional<OperationCount>& count) {
  if (!count) return nullptr;
  return {count->mul, count->add, count->div, count->calls};
}

std::optional<OperationCount> count_from(const Json& json) {
  if (json.is_null()) return std::nullopt;
  return OperationCount{json.at(0), json.at(1), json.at(2), json.at(3)};
}

}  // namespace

Json to_json(const WrittenPage& page) {
  Json texts = Json::array();
  for (const auto text : kTexts) texts.push_back(page.entry.*text);
  return {{"texts", texts},
          {"verdict", static_cast<int>(page.entry.verdict)},
          {"general", to_json(page.entry.general)},
          {"specialised", to_json(page.entry.specialised)},
          {"drift", page.entry.drift},
          {"json", page.json},
          {"status", page.status},
          {"problems", page.problems}};
}

WrittenPage written_page_from_json(const Json& json) {
  WrittenPage page;
  for (std::size_t i = 0; i < kTexts.size(); ++i)
    page.entry.*kTexts[i] = json.at("texts").at(i).get<std::string>();
  page.entry.verdict = static_cast<Verdict>(json.at("verdict").get<int>());
  page.entry.general = count_from(json.at("general"));
  page.entry.specialised = count_from(json.at("specialised"));
  page.entry.drift = json.at("drift");
  page.json = json.at("json");
  page.status = json.at("status");
  page.problems = json.at("problems").get<std::vector<std::string>>();
  return page;
}

}  // namespace casimir::tools
