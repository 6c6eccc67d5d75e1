#include "apps/stages/stage_cache.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <vector>

#include "apps/text/artifact.h"

namespace luxfit {
namespace {

using nlohmann::json;

constexpr char kFormat[] = "luxfit-stage-1";

std::string PathOf(const std::string& out, const std::string& stage) {
  return out + "/stages/" + stage + ".cbor";
}

std::optional<json> ReadKept(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  const std::vector<uint8_t> bytes((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  json kept = json::from_cbor(bytes, true, false);
  if (!kept.is_object() || kept.value("format", "") != kFormat || !kept.contains("inputs"))
    return std::nullopt;
  return kept;
}

void Write(const std::string& path, const json& kept) {
  const std::vector<uint8_t> bytes = json::to_cbor(kept);
  WriteText(path, std::string(bytes.begin(), bytes.end()));
}

// What a stage says beside its product.
class Sayings {
 public:
  explicit Sayings(const RunContext& context)
      : choices_(context.choices.size()), warnings_(context.warnings.size()) {}

  json Since(const RunContext& context) const {
    json choices = json::array(), warnings = json::array();
    for (size_t i = choices_; i < context.choices.size(); ++i) {
      const Choice& c = context.choices[i];
      choices.push_back({c.what, c.chosen, c.among, c.because});
    }
    for (size_t i = warnings_; i < context.warnings.size(); ++i) {
      const Warning& w = context.warnings[i];
      warnings.push_back({w.code, w.message, w.remedy});
    }
    return {{"choices", choices}, {"warnings", warnings}, {"undetermined", context.undetermined}};
  }

  static void Repeat(const json& said, RunContext& context) {
    for (const json& c : said.at("choices"))
      context.choices.push_back({c.at(0), c.at(1), c.at(2).get<std::vector<std::string>>(), c.at(3)});
    for (const json& w : said.at("warnings")) context.warnings.push_back({w.at(0), w.at(1), w.at(2)});
    context.undetermined = context.undetermined || said.at("undetermined").get<bool>();
  }

 private:
  size_t choices_, warnings_;
};

}  // namespace

json CachedStage(const std::string& stage, const StageInputs& inputs, RunContext& context,
                 const std::function<json()>& compute) {
  const std::string path = PathOf(context.out, stage);
  // Its artifact for people must be there as well.
  const bool is_whole = std::filesystem::exists(context.out + "/stages/" + stage + ".json");
  if (const auto kept = ReadKept(path); is_whole && kept && kept->at("inputs").get<StageInputs>() == inputs) {
    const StageTimer timer(context, stage, "nothing that it depends on has changed: that of the last run");
    Sayings::Repeat(kept->at("said"), context);
    context.reused_stages.push_back(stage);
    return kept->at("product");
  }
  const Sayings before(context);
  json product = compute();
  Write(path,
        {{"format", kFormat}, {"inputs", inputs}, {"said", before.Since(context)}, {"product", product}});
  return product;
}

std::optional<StageInputs> LastInputs(const std::string& out, const std::string& stage) {
  const auto kept = ReadKept(PathOf(out, stage));
  if (!kept) return std::nullopt;
  return kept->at("inputs").get<StageInputs>();
}

void KeepInputs(const std::string& out, const std::string& stage, const StageInputs& inputs) {
  Write(PathOf(out, stage), {{"format", kFormat}, {"inputs", inputs}});
}

}  // namespace luxfit
