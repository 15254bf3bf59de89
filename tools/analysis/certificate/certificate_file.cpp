#include "tools/analysis/certificate/certificate_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sodium.h>

#include <cln/rational_io.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "symbolic/algebra/number_text.hpp"
#include "symbolic/expression/expression.hpp"

namespace casimir {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kMostBytes = std::size_t{1} << 29;
/// Of arrays and objects in one another.
constexpr int kMostDepth = 8;
constexpr const char* kDigestKey = ",\n\"digest\": \"";
constexpr const char* kFileEnd = "\"}\n";
constexpr std::size_t kDigestBytes = 32;
constexpr int kFormat = 1;

std::string digest_of(const std::string& text) {
  std::array<unsigned char, kDigestBytes> hash{};
  crypto_generichash(hash.data(), hash.size(), reinterpret_cast<const unsigned char*>(text.data()),
                     text.size(), nullptr, 0);
  std::string result;
  for (const unsigned char byte : hash) result += fmt::format("{:02x}", byte);
  return result;
}

std::string quoted_json(const std::string& text) { return Json(text).dump(); }

std::string list_text(const std::vector<std::string>& texts) { return Json(texts).dump(); }

std::string step_text(const TracedStep& step) {
  std::string text = fmt::format("{{\"length\": {}, ", quoted_json(step.length));
  text += fmt::format("\"room\": {}, \"columns\": {}, \"middle\": {}, ", step.room,
                      Json(step.columns).dump(), list_text(step.after.middle));
  if (!step.after.carried.empty())
    text += fmt::format("\"carried\": {}, ", list_text(step.after.carried));
  return text + fmt::format("\"frame\": {}, \"rest\": {}}}", list_text(step.after.frame),
                            list_text(step.after.rest));
}

/// Takes a document apart, and says where it is not as expected.
class CertificateReader {
 public:
  /// \param limits  outlive it
  CertificateReader(std::string file, const Limits& limits)
      : file_(std::move(file)), limits_(limits) {}

  const Limits& limits() const { return limits_; }

  /// Of the text, from its beginning.
  [[noreturn]] void malformed_at(const std::string& text, std::size_t byte,
                                 const std::string& expected) const {
    const std::string before = text.substr(0, byte);
    const auto line = 1 + std::ranges::count(before, '\n');
    const std::size_t start = before.rfind('\n') == std::string::npos ? 0 : before.rfind('\n') + 1;
    throw CaseError({file_, static_cast<int>(line), static_cast<int>(byte - start) + 1},
                    "expected " + expected);
  }

  /// Of an entry, by its path.
  [[noreturn]] void malformed(const std::string& path, const std::string& expected) const {
    throw CaseError({file_}, fmt::format("{}: expected {}", path, expected));
  }

  void check_keys(const Json& json, const std::string& path,
                  const std::vector<std::string>& known) const {
    if (!json.is_object()) malformed(path.empty() ? "/" : path, "an object");
    for (const auto& [key, value] : json.items())
      if (std::ranges::find(known, key) == known.end())
        malformed(path + "/" + printable(key), fmt::format("one of {}", fmt::join(known, ", ")));
  }

  const Json& entry(const Json& json, const std::string& path, const char* key) const {
    const auto place = json.find(key);
    if (place == json.end()) malformed(path + "/" + key, "this entry, which is missing");
    return *place;
  }

  std::string text(const Json& json, const std::string& path, const char* key) const {
    const Json& value = entry(json, path, key);
    if (!value.is_string()) malformed(path + "/" + key, "a text");
    return value.get<std::string>();
  }

  int whole(const Json& json, const std::string& path, int least, int most) const {
    if (!json.is_number_integer() || json < least || json > most)
      malformed(path, fmt::format("a whole number from {} to {}", least, most));
    return json.get<int>();
  }

  /// \param size  how many there have to be; 0: any number of them.
  std::vector<std::string> numbers(const Json& json, const std::string& path,
                                   std::size_t size) const {
    if (!json.is_array() || (size > 0 && json.size() != size))
      malformed(path, size > 0 ? fmt::format("a list of {} numbers", size) : "a list of numbers");
    std::vector<std::string> result;
    for (std::size_t i = 0; i < json.size(); ++i)
      result.push_back(number(json[i], fmt::format("{}/{}", path, i)));
    return result;
  }

  std::string number(const Json& json, const std::string& path) const {
    if (!json.is_string() || !is_traced_number(json.get_ref<const std::string&>()))
      malformed(path, "a number such as \"-0x1b3p-52\"");
    return json.get<std::string>();
  }

 private:
  std::string file_;
  const Limits& limits_;
};

Json document_of(const std::string& text, const CertificateReader& reader) {
  const auto shallow = [&](int depth, Json::parse_event_t, Json&) {
    if (depth > kMostDepth) reader.malformed("/", "no more than eight lists in one another");
    return true;
  };
  try {
    return Json::parse(text, shallow);
  } catch (const Json::parse_error& problem) {
    reader.malformed_at(text, problem.byte > 0 ? problem.byte - 1 : 0, "JSON");
  } catch (const Json::exception&) {
    reader.malformed("/", "JSON of numbers of a moderate size");
  }
}

TracedStep step_of(const Json& json, const std::string& path, std::size_t n,
                   const CertificateReader& reader) {
  constexpr int kMostRoom = 100000;
  reader.check_keys(json, path,
                    {"length", "room", "columns", "middle", "carried", "frame", "rest"});
  TracedStep step;
  step.length = reader.number(reader.entry(json, path, "length"), path + "/length");
  step.room = reader.whole(reader.entry(json, path, "room"), path + "/room", -kMostRoom, kMostRoom);
  const Json& columns = reader.entry(json, path, "columns");
  if (!columns.is_array()) reader.malformed(path + "/columns", "a list");
  for (std::size_t i = 0; i < columns.size(); ++i)
    step.columns.push_back(reader.whole(columns[i], fmt::format("{}/columns/{}", path, i), -1,
                                        static_cast<int>(n) - 1));
  step.after.middle = reader.numbers(reader.entry(json, path, "middle"), path + "/middle", n);
  if (json.contains("carried"))
    step.after.carried = reader.numbers(json["carried"], path + "/carried", n * n);
  step.after.frame = reader.numbers(reader.entry(json, path, "frame"), path + "/frame", n * n);
  step.after.rest = reader.numbers(reader.entry(json, path, "rest"), path + "/rest", n);
  return step;
}

RunTrace trace_of(const Json& json, const std::string& path, const CertificateReader& reader) {
  constexpr std::size_t kMostStates = 1000;
  constexpr int kMostOrder = 2000, kMostBits = 20000;
  RunTrace trace;
  trace.order = reader.whole(reader.entry(json, path, "order"), path + "/order", 1, kMostOrder);
  trace.bits = reader.whole(reader.entry(json, path, "bits"), path + "/bits", 2, kMostBits);
  const Json& start = reader.entry(json, path, "start");
  const std::string at = path + "/start";
  reader.check_keys(start, at, {"middle", "off"});
  trace.middle = reader.numbers(reader.entry(start, at, "middle"), at + "/middle", 0);
  const std::size_t n = trace.middle.size();
  if (n == 0 || n > kMostStates)
    reader.malformed(at + "/middle", fmt::format("1 to {} numbers", kMostStates));
  trace.off = reader.numbers(reader.entry(start, at, "off"), at + "/off", n);
  const Json& steps = reader.entry(json, path, "steps");
  if (!steps.is_array() || steps.empty()) reader.malformed(path + "/steps", "a list of steps");
  for (std::size_t k = 0; k < steps.size(); ++k)
    trace.steps.push_back(step_of(steps[k], fmt::format("{}/steps/{}", path, k), n, reader));
  const Json& end = reader.entry(json, path, "end");
  if (!end.is_array() || end.size() != n)
    reader.malformed(path + "/end", fmt::format("a list of {} intervals", n));
  for (std::size_t i = 0; i < n; ++i) {
    const auto ends = reader.numbers(end[i], fmt::format("{}/end/{}", path, i), 2);
    trace.end.push_back({ends[0], ends[1]});
  }
  return trace;
}

cln::cl_RA rational_of(const Json& json, const std::string& path, const CertificateReader& reader) {
  const auto is_part = [](char c) { return (c >= '0' && c <= '9') || c == '/'; };
  constexpr std::size_t kLongest = 2000;
  if (json.is_string()) {
    const std::string& text = json.get_ref<const std::string&>();
    if (!text.empty() && text.size() <= kLongest && std::ranges::all_of(text, is_part)) {
      const GiNaC::ex value = parse_real_constant({text, {path, 1, 1}, text}, reader.limits());
      if (GiNaC::is_a<GiNaC::numeric>(value) && GiNaC::ex_to<GiNaC::numeric>(value).is_rational())
        return cln::the<cln::cl_RA>(GiNaC::ex_to<GiNaC::numeric>(value).to_cl_N());
    }
  }
  reader.malformed(path, "a fraction that is not negative, such as \"1/1000\"");
}

std::string trace_text(const RunTrace& trace) {
  std::string text = fmt::format(
      "\"order\": {}, \"bits\": {},\n\"start\": {{\"middle\": {}, \"off\": {}}},\n\"steps\": [\n",
      trace.order, trace.bits, list_text(trace.middle), list_text(trace.off));
  for (std::size_t k = 0; k < trace.steps.size(); ++k)
    text += step_text(trace.steps[k]) + (k + 1 < trace.steps.size() ? ",\n" : "],\n");
  return text + fmt::format("\"end\": {}", Json(trace.end).dump());
}

RunCertificate run_of(const Json& json, const CertificateReader& reader) {
  reader.check_keys(json, "",
                    {"certificate", "format", "case", "scene", "equations", "radii", "order",
                     "bits", "start", "steps", "end", "digest"});
  RunCertificate certificate;
  certificate.of_case = reader.text(json, "", "case");
  certificate.scene = reader.text(json, "", "scene");
  certificate.equations = reader.text(json, "", "equations");
  certificate.limits = reader.limits();
  const Json& radii = reader.entry(json, "", "radii");
  if (!radii.is_array()) reader.malformed("/radii", "a list");
  for (std::size_t i = 0; i < radii.size(); ++i)
    certificate.radii.push_back(rational_of(radii[i], fmt::format("/radii/{}", i), reader));
  certificate.trace = trace_of(json, "", reader);
  return certificate;
}

CycleCertificate cycle_of(const Json& json, const std::string& path,
                          const CertificateReader& reader) {
  reader.check_keys(
      json, path,
      {"case", "equations", "plane", "levels", "closing", "radius", "inverse", "point", "box"});
  CycleCertificate cycle;
  cycle.of_case = reader.text(json, path, "case");
  cycle.equations = reader.text(json, path, "equations");
  cycle.limits = reader.limits();
  cycle.plane = reader.text(json, path, "plane");
  cycle.levels = reader.numbers(reader.entry(json, path, "levels"), path + "/levels", 0);
  const Json& closing = reader.entry(json, path, "closing");
  constexpr int kMostStates = 1000;
  if (!closing.is_array()) reader.malformed(path + "/closing", "a list");
  for (const Json& one : closing)
    cycle.closing.push_back(reader.whole(one, path + "/closing", 0, kMostStates));
  cycle.radius = reader.number(reader.entry(json, path, "radius"), path + "/radius");
  cycle.inverse = reader.numbers(reader.entry(json, path, "inverse"), path + "/inverse", 0);
  for (const char* key : {"point", "box"}) {
    const Json& run = reader.entry(json, path, key);
    const std::string at = path + "/" + key;
    reader.check_keys(run, at, {"order", "bits", "start", "steps", "end"});
    (key == std::string("point") ? cycle.point : cycle.box) = trace_of(run, at, reader);
  }
  return cycle;
}

CertifiedSet set_of(const Json& json, const std::string& path, const CertificateReader& reader) {
  reader.check_keys(json, path, {"name", "centre", "frame", "sheet"});
  CertifiedSet set;
  set.name = reader.text(json, path, "name");
  set.centre = reader.numbers(reader.entry(json, path, "centre"), path + "/centre", 0);
  const std::size_t n = set.centre.size();
  if (n < 3) reader.malformed(path + "/centre", "three numbers or more");
  set.frame = reader.numbers(reader.entry(json, path, "frame"), path + "/frame", n * n);
  set.sheet = reader.numbers(reader.entry(json, path, "sheet"), path + "/sheet", n - 2);
  return set;
}

HorseshoeCertificate horseshoe_of(const Json& json, const CertificateReader& reader) {
  constexpr std::size_t kMostSets = 10000;
  reader.check_keys(json, "",
                    {"certificate", "format", "case", "equations", "plane", "levels", "sets",
                     "coverings", "digest"});
  HorseshoeCertificate certificate;
  certificate.of_case = reader.text(json, "", "case");
  certificate.equations = reader.text(json, "", "equations");
  certificate.limits = reader.limits();
  certificate.plane = reader.text(json, "", "plane");
  const Json& levels = reader.entry(json, "", "levels");
  if (!levels.is_array()) reader.malformed("/levels", "a list of intervals");
  for (std::size_t a = 0; a < levels.size(); ++a) {
    const auto ends = reader.numbers(levels[a], fmt::format("/levels/{}", a), 2);
    certificate.levels.push_back({ends[0], ends[1]});
  }
  const Json& sets = reader.entry(json, "", "sets");
  if (!sets.is_array() || sets.empty() || sets.size() > kMostSets)
    reader.malformed("/sets", fmt::format("a list of 1 to {} h-sets", kMostSets));
  for (std::size_t k = 0; k < sets.size(); ++k)
    certificate.sets.push_back(set_of(sets[k], fmt::format("/sets/{}", k), reader));
  const Json& coverings = reader.entry(json, "", "coverings");
  if (!coverings.is_array()) reader.malformed("/coverings", "a list of pairs");
  const auto last = static_cast<int>(sets.size()) - 1;
  std::set<decltype(certificate.coverings)::value_type> listed;
  for (std::size_t k = 0; k < coverings.size(); ++k) {
    const std::string path = fmt::format("/coverings/{}", k);
    if (!coverings[k].is_array() || coverings[k].size() != 2) reader.malformed(path, "a pair");
    certificate.coverings.emplace_back(reader.whole(coverings[k][0], path + "/0", 0, last),
                                       reader.whole(coverings[k][1], path + "/1", 0, last));
    if (!listed.insert(certificate.coverings.back()).second)
      reader.malformed(path, "a covering that was not listed before");
  }
  return certificate;
}

}  // namespace

std::string with_digest(const std::string& text) {
  return text + kDigestKey + digest_of(text) + kFileEnd;
}

std::string certificate_text(const RunCertificate& certificate) {
  std::vector<std::string> radii;
  for (const cln::cl_RA& radius : certificate.radii) radii.push_back(rational_text(radius));
  return with_digest(fmt::format(
      "{{\"certificate\": \"run\", \"format\": {},\n\"case\": {}, \"scene\": {},\n"
      "\"equations\": {},\n\"radii\": {},\n{}",
      kFormat, quoted_json(certificate.of_case), quoted_json(certificate.scene),
      quoted_json(certificate.equations), list_text(radii), trace_text(certificate.trace)));
}

std::string certificate_text(const std::vector<CycleCertificate>& cycles) {
  std::string text =
      fmt::format("{{\"certificate\": \"cycles\", \"format\": {},\n\"cycles\": [", kFormat);
  for (std::size_t k = 0; k < cycles.size(); ++k) {
    const CycleCertificate& cycle = cycles[k];
    text += fmt::format(
        "{}\n{{\"case\": {}, \"equations\": {},\n\"plane\": {}, \"levels\": {}, \"closing\": {}, "
        "\"radius\": {},\n\"inverse\": {},\n\"point\": {{{}}},\n\"box\": {{{}}}}}",
        k > 0 ? "," : "", quoted_json(cycle.of_case), quoted_json(cycle.equations),
        quoted_json(cycle.plane), list_text(cycle.levels), Json(cycle.closing).dump(),
        quoted_json(cycle.radius), list_text(cycle.inverse), trace_text(cycle.point),
        trace_text(cycle.box));
  }
  return with_digest(text + "]");
}

std::string certificate_text(const HorseshoeCertificate& certificate) {
  std::string text = fmt::format(
      "{{\"certificate\": \"horseshoe\", \"format\": {},\n\"case\": {},\n\"equations\": {},\n"
      "\"plane\": {},\n\"levels\": {},\n\"sets\": [\n",
      kFormat, quoted_json(certificate.of_case), quoted_json(certificate.equations),
      quoted_json(certificate.plane), Json(certificate.levels).dump());
  for (std::size_t k = 0; k < certificate.sets.size(); ++k) {
    const CertifiedSet& set = certificate.sets[k];
    text += fmt::format("{{\"name\": {}, \"centre\": {}, \"frame\": {}, \"sheet\": {}}}{}",
                        quoted_json(set.name), list_text(set.centre), list_text(set.frame),
                        list_text(set.sheet), k + 1 < certificate.sets.size() ? ",\n" : "],\n");
  }
  return with_digest(text + fmt::format("\"coverings\": {}", Json(certificate.coverings).dump()));
}

CertificateFile read_certificate(const std::string& text, const std::string& file,
                                 const Limits& limits) {
  const CertificateReader reader(file, limits);
  if (text.size() > kMostBytes) reader.malformed("/", "a file of at most 512 MiB");
  const std::size_t length =
      std::string(kDigestKey).size() + 2 * kDigestBytes + std::string(kFileEnd).size();
  const std::size_t body = text.size() < length ? 0 : text.size() - length;
  if (text.compare(body, std::string(kDigestKey).size(), kDigestKey) != 0)
    reader.malformed_at(text, text.size(), "a digest at the end: the file is not complete");
  if (with_digest(text.substr(0, body)) != text)
    reader.malformed_at(text, body + 2, "the digest of another text: the file has been changed");
  const Json json = document_of(text, reader);
  if (!json.is_object()) reader.malformed("/", "an object");
  const std::string kind = reader.text(json, "", "certificate");
  reader.whole(reader.entry(json, "", "format"), "/format", kFormat, kFormat);
  CertificateFile result;
  if (kind == "run") {
    result.run = run_of(json, reader);
    return result;
  }
  if (kind == "horseshoe") {
    result.horseshoe = horseshoe_of(json, reader);
    return result;
  }
  if (kind != "cycles") reader.malformed("/certificate", "\"run\", \"cycles\" or \"horseshoe\"");
  reader.check_keys(json, "", {"certificate", "format", "cycles", "digest"});
  const Json& cycles = reader.entry(json, "", "cycles");
  if (!cycles.is_array() || cycles.empty()) reader.malformed("/cycles", "a list of cycles");
  for (std::size_t k = 0; k < cycles.size(); ++k)
    result.cycles.push_back(cycle_of(cycles[k], fmt::format("/cycles/{}", k), reader));
  return result;
}

}  // namespace casimir
