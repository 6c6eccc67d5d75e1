#include "apps/stages/stage_cache.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/text/formats/artifact.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr char kFormat[] = "luxfit-stage-5";

std::string PathOf(const std::string& out, const std::string& stage) {
  return out + "/stages/" + stage + ".cbor";
}

std::string HashBytes(const std::vector<uint8_t>& bytes) { return HashText({bytes.begin(), bytes.end()}); }

// A file holds its format, its content as CBOR, and the hash of that.
std::optional<json> ReadKept(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  const std::vector<uint8_t> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const json kept = json::from_cbor(bytes, true, false);
  if (!kept.is_object() || !kept.contains("format") || kept.at("format") != kFormat) return std::nullopt;
  if (!kept.contains("hash") || !kept.contains("content") || !kept.at("content").is_binary())
    return std::nullopt;
  const std::vector<uint8_t>& content = kept.at("content").get_binary();
  if (kept.at("hash") != HashBytes(content)) return std::nullopt;
  return json::from_cbor(content);
}

void Write(const std::string& path, const json& kept) {
  const std::vector<uint8_t> content = json::to_cbor(kept);
  const std::vector<uint8_t> bytes = json::to_cbor(
      json{{"format", kFormat}, {"hash", HashBytes(content)}, {"content", json::binary(content)}});
  WriteText(path, std::string(bytes.begin(), bytes.end()));
}

json Sayings(const RunContext& context, const StageMark& mark) {
  json choices = json::array(), warnings = json::array();
  for (size_t i = mark.choices; i < context.choices.size(); ++i) {
    const Choice& c = context.choices[i];
    choices.push_back({c.what, c.chosen, c.among, c.because});
  }
  for (size_t i = mark.warnings; i < context.warnings.size(); ++i) {
    const Warning& w = context.warnings[i];
    warnings.push_back({w.code, w.message, w.remedy, w.is_of_outcome});
  }
  return {{"choices", choices}, {"warnings", warnings}};
}

void Repeat(const json& said, RunContext& context) {
  for (const json& c : said.at("choices"))
    context.choices.push_back({c.at(0), c.at(1), c.at(2).get<std::vector<std::string>>(), c.at(3)});
  for (const json& w : said.at("warnings")) context.warnings.push_back({w.at(0), w.at(1), w.at(2), w.at(3)});
}

}  // namespace

std::optional<json> KeptProduct(const std::string& stage, const StageInputs& inputs, RunContext& context) {
  // The readable artifact of the stage must exist as well.
  if (!std::filesystem::exists(context.out + "/stages/" + stage + ".json")) return std::nullopt;
  const auto kept = ReadKept(PathOf(context.out, stage));
  if (!kept || kept->at("inputs").get<StageInputs>() != inputs) return std::nullopt;
  const StageTimer timer(context, stage, "nothing that it depends on has changed: that of the last run");
  Repeat(kept->at("said"), context);
  context.reused_stages.push_back(stage);
  return kept->at("product");
}

void KeepProduct(const std::string& stage, const StageInputs& inputs, const RunContext& context,
                 const StageMark& mark, const json& product) {
  Write(PathOf(context.out, stage),
        {{"inputs", inputs}, {"said", Sayings(context, mark)}, {"product", product}});
}

std::optional<StageInputs> LastInputs(const std::string& out, const std::string& stage) {
  const auto kept = ReadKept(PathOf(out, stage));
  if (!kept) return std::nullopt;
  return kept->at("inputs").get<StageInputs>();
}

void KeepInputs(const std::string& out, const std::string& stage, const StageInputs& inputs) {
  Write(PathOf(out, stage), {{"inputs", inputs}});
}

}  // namespace luxfit
