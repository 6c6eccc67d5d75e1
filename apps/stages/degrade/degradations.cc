#include "apps/stages/degrade/degradations.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "apps/stages/degrade/degradation_rows.h"
#include "apps/text/suggest.h"
#include "inverse/study/degrade.h"

namespace luxfit {
namespace {

// Returns the same random numbers at every level of one degradation's trial.
std::mt19937_64 RngOf(uint64_t seed, const std::string& name, int trial) {
  std::vector<uint32_t> words{static_cast<uint32_t>(seed), static_cast<uint32_t>(seed >> 32),
                              static_cast<uint32_t>(trial)};
  for (const char c : name) words.push_back(static_cast<uint32_t>(c));
  std::seed_seq sequence(words.begin(), words.end());
  return std::mt19937_64(sequence);
}

}  // namespace

const std::vector<Degradation>& AllDegradations() {
  static const std::vector<Degradation> all{PixelNoise(),         ExposureErrors(), ViewsDropped(),
                                            StatesDropped(),      TagsMoved(),      FacesRemoved(),
                                            LuminairesTogether(), AlbedoRaised()};
  return all;
}

int ShareOf(double percent, int count, int left) {
  return std::clamp(static_cast<int>(std::lround(percent / 100 * count)), 1, count - left);
}

std::vector<Degradation> DegradationsNamed(const std::vector<std::string>& names) {
  if (names.empty()) return AllDegradations();
  std::vector<std::string> known;
  for (const Degradation& d : AllDegradations()) known.push_back(d.name);
  for (const std::string& name : names) {
    if (std::count(known.begin(), known.end(), name) == 0)
      throw std::runtime_error("--only: " + ExpectedOneOf(known, name));
  }
  std::vector<Degradation> chosen;
  for (const Degradation& d : AllDegradations()) {
    if (std::count(names.begin(), names.end(), d.name) > 0) chosen.push_back(d);
  }
  return chosen;
}

DegradedSessions::DegradedSessions(const PreparedSession& prepared, std::vector<EstimatedLuminaire> truth,
                                   int max_elements, uint64_t seed, RunContext& context)
    : whole_{prepared, max_elements, Thinned(prepared.observed, max_elements), {}, std::move(truth), {}, {}},
      seed_(seed),
      context_(context) {
  whole_.refit = RefitSession(prepared.session, prepared.linearized, prepared.room, whole_.observed, context);
  const Refit& refit = whole_.refit;
  if (whole_.truth.empty()) whole_.truth = refit.luminaires;
  const std::array<const std::vector<Warning>*, 2> known{&refit.warnings, &context.warnings};
  for (const std::vector<Warning>* warnings : known) {
    for (const Warning& warning : *warnings) known_warnings_.push_back(warning.code);
  }
  undegraded_score_ = ScoreFit(refit.luminaires, whole_.truth, !refit.warnings.empty());
}

std::optional<std::string> DegradedSessions::WhyNot(const Degradation& degradation) const {
  if (auto why = degradation.why_not(whole_)) return why;
  if (whole_.refit.undetermined) return "the undegraded session leaves its luminaires undetermined";
  return std::nullopt;
}

DegradedFit DegradedSessions::Fit(const Degradation& degradation, double level, int trial) {
  std::mt19937_64 rng = RngOf(seed_, degradation.name, trial);
  DegradedFit result;
  const auto start = std::chrono::steady_clock::now();
  try {
    DegradedCase c;
    c.session = whole_.prepared.session;
    c.linearized = whole_.prepared.linearized;
    c.room = &whole_.prepared.room;
    c.observed = whole_.observed;
    c.truth = whole_.truth;
    c.context.out = context_.out;
    c.context.is_quiet = true;
    degradation.apply(whole_, level, rng, c);
    result.refit = RefitSession(c.session, c.linearized, *c.room, c.observed, context_);
    std::vector<Warning>& warnings = result.refit.warnings;
    warnings.insert(warnings.end(), c.context.warnings.begin(), c.context.warnings.end());
    for (const Warning& warning : warnings) {
      if (std::count(known_warnings_.begin(), known_warnings_.end(), warning.code) == 0)
        result.new_warnings.push_back(warning.code);
    }
    result.score = ScoreFit(result.refit.luminaires, c.truth, !result.new_warnings.empty());
  } catch (const std::runtime_error& e) {  // what the program says instead of a result
    result.failed = true;
    result.message = e.what();
    result.score = ScoreFit({}, whole_.truth, true);
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

}  // namespace luxfit
