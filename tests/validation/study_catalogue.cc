// Runs `luxfit fit` on the shipped office with one thing wrong, case by case: is it right, and does it name the cause?
//
//   study_catalogue -o FOLDER [--quick] [--only WORDS]
//
// Cases: tests/validation/catalogue. A result is right where every luminaire is within 50 mm and 10 % of the truth. "rank": the place
// of the warning that names the cause among those that the right session does not give; 0: none. Prints catalogue.csv, a line a
// case, and writes it to FOLDER. Ends with 1 where a case is wrong and sure: not right, exit 0, no warning. --only: cases
// whose group or name has these words. --quick: two cases.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "apps/text/formats/artifact.h"
#include "tests/support/office_truth.h"
#include "tests/support/study_options.h"
#include "tests/validation/catalogue/catalogue_case.h"

namespace luxfit {
namespace {

using nlohmann::json;

struct Outcome {
  int status = -1;
  bool is_right = false, is_sure = true;
  int rank = 0;
  double worst_mm = std::nan(""), worst_percent = std::nan("");
  std::vector<std::string> codes;  // those that the right session does not give
  std::string error;               // first line of it
};

std::vector<CatalogueCase> AllCases() {
  std::vector<CatalogueCase> all;
  for (const auto& cases :
       {RegistrationCases(), PhotometryCases(), LuminaireCases(), GeometryCases(), LuxmeterCases()})
    all.insert(all.end(), cases.begin(), cases.end());
  return all;
}

// Returns the luminaire found nearest to a place, which may have another name.
const json* Nearest(const json& luminaires, const json& position, double& distance_m) {
  const json* nearest = nullptr;
  for (const json& found : luminaires) {
    double squares = 0;
    for (size_t axis = 0; axis < 3; ++axis)
      squares += std::pow(found["position_m"][axis].get<double>() - position[axis].get<double>(), 2);
    if (nearest != nullptr && !(std::sqrt(squares) < distance_m)) continue;
    distance_m = std::sqrt(squares);
    nearest = &found;
  }
  return nearest;
}

void Score(const json& result, const std::string& daylight, Outcome& outcome) {
  constexpr double kMost_mm = 50, kMostPercent = 10;
  outcome.worst_mm = outcome.worst_percent = 0;
  json truth = support::OfficeTruth()["lamps"];
  const auto end =
      std::remove_if(truth.begin(), truth.end(), [&](const json& lamp) { return lamp["id"] == daylight; });
  truth.erase(end, truth.end());
  for (const json& lamp : truth) {
    double distance_m = 0;
    const json* const found = Nearest(result["luminaires"], lamp["position"], distance_m);
    const bool has_flux = found != nullptr && (*found)["flux_lm"].is_number();
    const double ratio =
        has_flux ? (*found)["flux_lm"].get<double>() / lamp["flux_lm"].get<double>() : std::nan("");
    outcome.worst_mm = found != nullptr ? std::max(outcome.worst_mm, 1000 * distance_m) : std::nan("");
    outcome.worst_percent = std::isnan(ratio) || std::isnan(outcome.worst_percent)
                                ? std::nan("")
                                : std::max(outcome.worst_percent, 100 * std::abs(ratio - 1));
  }
  outcome.is_right = result["luminaires"].size() == truth.size() && outcome.worst_mm < kMost_mm &&
                     outcome.worst_percent < kMostPercent;
}

bool HasAny(const std::string& text, const std::vector<std::string>& causes) {
  return std::any_of(causes.begin(), causes.end(),
                     [&](const std::string& cause) { return text.find(cause) != std::string::npos; });
}

std::string Without(const std::string& folder, std::string text) {
  for (size_t at = text.find(folder); at != std::string::npos; at = text.find(folder))
    text.erase(at, folder.size());
  return text;
}

Outcome RunCase(const CatalogueCase& wrong, const std::set<std::string>& known) {
  const support::OfficeCopy office;
  wrong.make(office);
  const support::ProgramRun run = office.Run("fit");
  Outcome outcome;
  outcome.status = run.status;
  if (run.status > 1) {
    const size_t at = run.output.rfind("luxfit: ");
    outcome.error = Without(office.Path(""), at == std::string::npos ? run.output : run.output.substr(at));
    outcome.rank = HasAny(outcome.error, wrong.causes) ? 1 : 0;
    outcome.is_sure = false;
    return outcome;
  }
  const json result = office.Json("out/result.json");
  for (const json& warning : result["warnings"])
    if (known.count(warning["code"]) == 0) outcome.codes.push_back(warning["code"]);
  for (size_t i = outcome.codes.size(); i-- > 0;)
    if (std::count(wrong.causes.begin(), wrong.causes.end(), outcome.codes[i]) > 0)
      outcome.rank = static_cast<int>(i) + 1;
  outcome.is_sure = run.status == 0 && outcome.codes.empty();
  Score(result, wrong.daylight, outcome);
  return outcome;
}

bool IsMet(Required required, const Outcome& outcome) {
  if (required == Required::kSolved) return outcome.is_right && outcome.status == 0;
  const bool is_named = outcome.rank > 0;
  return required == Required::kNamed ? is_named : is_named && outcome.status == 2;
}

std::string VerdictOf(const Outcome& outcome) {
  if (outcome.status > 1) return outcome.rank > 0 ? "refused (named)" : "refused";
  if (outcome.is_sure) return outcome.is_right ? "right" : "WRONG AND SURE";
  return fmt::format("{} ({})", outcome.is_right ? "right" : "off", outcome.rank > 0 ? "named" : "warned");
}

std::string ToString(Required required) {
  if (required == Required::kSolved) return "solved";
  return required == Required::kNamed ? "named" : "refused";
}

std::string Line(const CatalogueCase& of_case, const Outcome& outcome) {
  std::vector<std::string> codes;  // each once
  for (const std::string& code : outcome.codes)
    if (std::count(codes.begin(), codes.end(), code) == 0) codes.push_back(code);
  std::string error = outcome.error.substr(0, outcome.error.find('\n'));
  std::replace(error.begin(), error.end(), '"', '\'');
  return fmt::format("{},\"{}\",{},{},{},{},{},{:.1f},{:.2f},{},\"{}\"\n", of_case.group, of_case.name,
                     ToString(of_case.required), IsMet(of_case.required, outcome) ? "yes" : "NO",
                     VerdictOf(outcome), outcome.status, outcome.rank, outcome.worst_mm,
                     outcome.worst_percent, fmt::join(codes, " "), error);
}

std::vector<CatalogueCase> CasesAsked(int argc, char** argv, bool is_quick) {
  std::vector<CatalogueCase> cases = AllCases();
  std::string only;
  for (int i = 1; i + 1 < argc; ++i)
    if (std::strcmp(argv[i], "--only") == 0) only = argv[i + 1];
  const auto is_left_out = [&](const CatalogueCase& c) {
    const bool is_of_quick =
        c.name == "mesh in mm, said to be m" || c.name == "two photos of a view exchanged";
    const bool is_asked = (c.group + " " + c.name).find(only) != std::string::npos;
    return !is_asked || (is_quick && !is_of_quick);
  };
  cases.erase(std::remove_if(cases.begin(), cases.end(), is_left_out), cases.end());
  return cases;
}

std::set<std::string> CodesOfTheRightSession() {
  const support::OfficeCopy office;
  office.Run("fit");
  std::set<std::string> codes;
  const json result = office.Json("out/result.json");
  for (const json& warning : result["warnings"]) codes.insert(warning["code"]);
  return codes;
}

int Run(int argc, char** argv) {
  const std::optional<support::StudyOptions> study = support::ReadStudyOptions(argc, argv);
  if (!study) return 2;
  const std::set<std::string> known = CodesOfTheRightSession();
  std::string table =
      "group,case,required,met,outcome,exit,rank,worst_mm,worst_flux_percent,warnings,error\n";
  std::fputs(table.c_str(), stdout);
  bool is_any_wrong = false;
  for (const CatalogueCase& of_case : CasesAsked(argc, argv, study->is_quick)) {
    const Outcome outcome = RunCase(of_case, known);
    const std::string line = Line(of_case, outcome);
    std::fputs(line.c_str(), stdout);
    std::fflush(stdout);
    table += line;
    is_any_wrong = is_any_wrong || (outcome.is_sure && !outcome.is_right);
  }
  WriteText(study->folder + "/catalogue.csv", table);
  return is_any_wrong ? 1 : 0;
}

}  // namespace
}  // namespace luxfit

int main(int argc, char** argv) { return luxfit::Run(argc, argv); }
