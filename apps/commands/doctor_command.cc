#include "apps/commands/doctor_command.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "apps/commands/internal/examine_session.h"
#include "apps/session/session.h"
#include "apps/text/formats/artifact.h"
#include "apps/text/process.h"
#include "apps/text/terminal.h"
#include "apps/version.h"

namespace luxfit {
namespace {

constexpr double kEnoughMemoryGb = 4;

std::string Name(Health health) {
  return health == Health::kGood ? "good" : (health == Health::kNote ? "note" : "bad");
}

std::string Text(const std::vector<DoctorFinding>& findings) {
  std::string text;
  for (const DoctorFinding& finding : findings) {
    text += fmt::format("{:<5} {}\n", Name(finding.health), finding.what);
    if (!finding.remedy.empty()) text += "      " + finding.remedy + "\n";
  }
  return text;
}

}  // namespace

std::vector<DoctorFinding> ExamineMachine() {
  const double memory_gb =
      1e-9 * static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  std::vector<DoctorFinding> findings = {
      {Health::kGood, fmt::format("luxfit {}, {} cores", kVersion, std::thread::hardware_concurrency()), ""}};
  if (memory_gb >= kEnoughMemoryGb) {
    findings.push_back({Health::kGood, fmt::format("{:.0f} GB of memory", memory_gb), ""});
  } else {
    findings.push_back({Health::kNote, fmt::format("{:.1f} GB of memory", memory_gb),
                        "rooms of many patches need 4 GB and more; leave out details of the mesh"});
  }
  if (IsInstalled("colmap")) {
    findings.push_back(
        {Health::kGood, "colmap is installed: views without tags can be placed by features", ""});
  } else {
    findings.push_back({Health::kNote, "colmap is not installed: views without tags are left out",
                        "apt-get install colmap, or show every view a tag"});
  }
  return findings;
}

int DoctorCommand(const DoctorCommandOptions& options) {
  std::vector<DoctorFinding> findings = ExamineMachine();
  if (!options.session.empty()) {
    const std::vector<DoctorFinding> of_session = ExamineSession(ReadSession(options.session));
    findings.insert(findings.end(), of_session.begin(), of_session.end());
  }
  const bool is_bad = std::any_of(findings.begin(), findings.end(),
                                  [](const DoctorFinding& f) { return f.health == Health::kBad; });
  std::string text = Text(findings);
  if (options.json) {
    nlohmann::json list = nlohmann::json::array();
    for (const DoctorFinding& f : findings)
      list.push_back({{"health", Name(f.health)}, {"what", f.what}, {"fix", f.remedy}});
    text = JsonText(nlohmann::json{{"findings", list}});
  }
  PrintText(text);
  return is_bad ? 1 : 0;
}

}  // namespace luxfit
