#include "inverse/observe/as_if/mesh_as_if.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "calib/register/mesh_alignment.h"
#include "forward/changes/frame_mistakes.h"
#include "forward/room/visibility.h"
#include "inverse/furniture/internal/sampled_agreement.h"
#include "inverse/observe/scene_surface.h"
#include "inverse/select/contradicted.h"

namespace luxfit {
namespace {

constexpr size_t kFewestViewsOfMesh = 3, kFewestTags = 4;
constexpr int kFewestPixels = 100;
constexpr double kLeastAgreement =
    0.1;  // rooms that mirror and are half empty in the mesh still agree on a fifth
constexpr double kTagOnMeshM = 0.01, kRoughM = 1, kLeastMotionM = 0.02, kStartM = 0.1;
constexpr double kTurnSeen_rad = 2e-3, kLeastShiftM = 2e-3, kUpright = 0.999, kNoShiftM = 1e-3;

constexpr char kMapInstead[] = ", or correct the tag map where the mesh is right";

struct Candidate {
  MeshExplanation explanation;
  Scene mesh;
  bool is_motion = false;
  std::vector<PixelSample> samples;
};

int TagsOn(const Scene& mesh, const std::vector<SurveyedTag>& survey) {
  return static_cast<int>(std::count_if(survey.begin(), survey.end(), [&](const SurveyedTag& tag) {
    return DistanceToSurface(mesh, tag.center_in_world) < kTagOnMeshM;
  }));
}

bool IsMost(int tags, size_t of) { return 10 * tags >= 9 * static_cast<int>(of); }

// Says what a map of FrameMistakesOf makes of the coordinates that it changes: "6 - x for x".
std::string CoordinatesText(const Eigen::Affine3d& map) {
  std::string text;
  for (int row = 0; row < 2; ++row) {
    const int from = std::abs(map.linear()(row, 0)) > 0.5 ? 0 : 1;
    const bool is_negative = map.linear()(row, from) < 0;
    const double offset = map.translation()[row];
    if (from == row && !is_negative && std::abs(offset) < kNoShiftM) continue;
    const char name = "xy"[from];
    std::string term = fmt::format("{}{}", is_negative ? "-" : "", name);
    if (std::abs(offset) >= kNoShiftM)
      term = is_negative ? fmt::format("{:.4g} - {}", offset, name)
                         : fmt::format("{} {} {:.4g}", name, offset < 0 ? '-' : '+', std::abs(offset));
    text += fmt::format("{}{} for {}", text.empty() ? "" : ", ", term, "xy"[row]);
  }
  return text;
}

Candidate CandidateOf(Scene moved, const FrameMistake& mistake, bool is_furniture_alone) {
  MeshExplanation e;
  const char* const whose = is_furniture_alone ? "the furniture of the mesh" : "the mesh";
  e.as_if = mistake.as_if + (is_furniture_alone ? " in its furniture alone" : "");
  e.remedy = fmt::format("export {} with {}", whose, CoordinatesText(mistake.right_from_given));
  e.right_from_given = mistake.right_from_given;
  e.is_furniture_alone = is_furniture_alone;
  return {std::move(e), std::move(moved), false, {}};
}

std::vector<Candidate> FrameCandidates(const Scene& mesh) {
  std::vector<Candidate> candidates;
  const std::vector<int> furniture = FurnitureOf(mesh);
  for (const FrameMistake& mistake : FrameMistakesOf(mesh)) {
    candidates.push_back(CandidateOf(WithMeshMapped(mesh, mistake.right_from_given), mistake, false));
    if (!furniture.empty() && !mistake.is_about_origin)
      candidates.push_back(
          CandidateOf(WithFacetsMapped(mesh, furniture, mistake.right_from_given), mistake, true));
  }
  return candidates;
}

// Returns how far the motion takes the farthest of the tags, m.
double FarthestM(const Eigen::Isometry3d& motion, const std::vector<SurveyedTag>& survey) {
  double farthest_m = 0;
  for (const SurveyedTag& tag : survey)
    farthest_m = std::max(farthest_m, (motion * tag.center_in_world - tag.center_in_world).norm());
  return farthest_m;
}

double Rounded(double value, double to) { return std::round(value / to) * to + 0.0; }

// Says what a motion does to the mesh: the shift of its middle, and its turn.
std::string MotionText(const Eigen::Isometry3d& motion, const Eigen::Vector3d& middle) {
  const Eigen::Vector3d shift_m = motion * middle - middle;
  std::string shift = fmt::format("({:.3f}, {:.3f}, {:.3f}) m", Rounded(shift_m.x(), 1e-3),
                                  Rounded(shift_m.y(), 1e-3), Rounded(shift_m.z(), 1e-3));
  const Eigen::AngleAxisd turn(motion.linear());
  if (turn.angle() < kTurnSeen_rad) return shift;
  const double sign = turn.axis().z() < 0 ? -1 : 1;
  const Eigen::Vector3d axis = sign * turn.axis();
  const double deg = sign * turn.angle() * 180 / M_PI;
  const std::string about = axis.z() > kUpright
                                ? "z"
                                : fmt::format("({:.2f}, {:.2f}, {:.2f})", Rounded(axis.x(), 0.01),
                                              Rounded(axis.y(), 0.01), axis.z());
  const std::string turned = fmt::format("{:.2f} degrees about {} through its middle", deg, about);
  return shift_m.norm() < kLeastShiftM ? turned : fmt::format("{} and {}", shift, turned);
}

// Returns how the tags have to move to lie on a mesh; nothing where they do not tell. `start_m`: a shift to begin with.
std::optional<Eigen::Isometry3d> TagsMovedOnto(const Scene& mesh, const std::vector<SurveyedTag>& survey,
                                               const Eigen::Vector3d& start_m) {
  Eigen::Matrix3Xd corners(3, static_cast<Eigen::Index>(4 * survey.size()));
  for (size_t i = 0; i < survey.size(); ++i)
    for (size_t k = 0; k < 4; ++k)
      corners.col(static_cast<Eigen::Index>(4 * i + k)) = TagCornersInWorld(survey[i])[k];
  SurfaceAlignmentOptions options;
  options.scale_is_free = false;
  options.rough_m = kRoughM;
  Similarity start;
  start.translation = start_m;
  const SurfaceAlignment aligned = AlignPointsToSurface(corners, SurfaceOf(mesh), start, options);
  if (!aligned.is_determined) return std::nullopt;
  Eigen::Isometry3d moved = Eigen::Isometry3d::Identity();
  moved.linear() = aligned.world_from_points.rotation;
  moved.translation() = aligned.world_from_points.translation;
  return moved;
}

// Returns shifts to begin with: a desk's underside may be nearer to a tag than its top.
std::vector<Eigen::Vector3d> Starts() {
  std::vector<Eigen::Vector3d> starts{Eigen::Vector3d::Zero()};
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) starts.emplace_back(sign * kStartM * Eigen::Vector3d::Unit(axis));
  return starts;
}

// Returns the motion that lays most of the tags on the mesh; nothing where they lie there as it is, or none does that.
std::optional<Candidate> MotionCandidate(const Scene& mesh, const std::vector<SurveyedTag>& survey) {
  std::optional<Candidate> best;
  if (survey.size() < kFewestTags || IsMost(TagsOn(mesh, survey), survey.size())) return best;
  int most = 0;
  for (const Eigen::Vector3d& start_m : Starts()) {
    const std::optional<Eigen::Isometry3d> given_from_right = TagsMovedOnto(mesh, survey, start_m);
    if (!given_from_right || FarthestM(*given_from_right, survey) < kLeastMotionM) continue;
    const Eigen::Isometry3d right_from_given = given_from_right->inverse();
    Scene moved = WithMeshMapped(mesh, right_from_given);
    const int tags = TagsOn(moved, survey);
    if (tags <= most || !IsMost(tags, survey.size())) continue;
    most = tags;
    MeshExplanation e;
    e.right_from_given = right_from_given;
    const Eigen::Vector3d middle = mesh.Bounds().center();
    e.as_if =
        "displaced against the surveyed tags by " + MotionText(*given_from_right, right_from_given * middle);
    e.remedy = "move the mesh by " + MotionText(right_from_given, middle) + kMapInstead;
    best = Candidate{e, std::move(moved), true, {}};
  }
  return best;
}

// Tells whether all tags that the mesh misses face up: they may lie on desks that it lacks.
bool MissesOnlyTagsThatFaceUp(const Scene& mesh, const std::vector<SurveyedTag>& survey) {
  return std::all_of(survey.begin(), survey.end(), [&](const SurveyedTag& tag) {
    return tag.normal_in_world.z() > kUpright || DistanceToSurface(mesh, tag.center_in_world) < kTagOnMeshM;
  });
}

void CountTags(const std::vector<SurveyedTag>& survey, int tags_as_given, Candidate& candidate) {
  MeshExplanation& e = candidate.explanation;
  e.tags = static_cast<int>(survey.size());
  e.tags_on_mesh_as_given = tags_as_given;
  e.tags_on_mesh = TagsOn(candidate.mesh, survey);
}

std::vector<Candidate> CandidatesOf(const Scene& mesh, const std::vector<SurveyedTag>& survey) {
  std::vector<Candidate> candidates = FrameCandidates(mesh);
  if (std::optional<Candidate> moved = MotionCandidate(mesh, survey)) candidates.push_back(std::move(*moved));
  const int as_given = TagsOn(mesh, survey);
  for (Candidate& candidate : candidates) CountTags(survey, as_given, candidate);
  const auto loses_tags = [&](const Candidate& candidate) {
    const int tags = candidate.explanation.tags_on_mesh;
    return tags < as_given;
  };
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(), loses_tags), candidates.end());
  return candidates;
}

// Tells whether a is explained by more than two standard errors better than b.
bool IsBetter(const GroupScores& a, const GroupScores& b) {
  const PairedDifference d = Difference(a, b);
  return d.mean > 2 * d.standard_error;
}

// Compares a candidate with the mesh as given, and tells whether it holds.
bool Holds(const std::vector<PixelSample>& as_given, Candidate& candidate) {
  const ComparedMeshes compared = CompareMeshes(candidate.samples, as_given);
  if (compared.pixels < kFewestPixels) return false;
  MeshExplanation& e = candidate.explanation;
  e.agreement = Mean(compared.a);
  e.agreement_as_given = Mean(compared.b);
  if (e.agreement < kLeastAgreement) return false;
  // IsContradicted takes errors, of which more is worse. Less agreement is worse, so that the two change places.
  return candidate.is_motion ? IsBetter(compared.a, compared.b) : IsContradicted(compared.a, compared.b);
}

bool IsRefused(const Candidate& best, const Candidate& other) {
  const ComparedMeshes compared = CompareMeshes(best.samples, other.samples);
  return compared.pixels >= kFewestPixels && IsBetter(compared.a, compared.b);
}

}  // namespace

std::vector<MeshExplanation> FindMeshAsIf(const Scene& mesh, const std::vector<SignatureView>& views,
                                          const std::vector<SurveyedTag>& survey, double tolerance) {
  if (views.size() < kFewestViewsOfMesh || mesh.facets.empty()) return {};
  std::vector<Candidate> candidates = CandidatesOf(mesh, survey);
  if (candidates.empty()) return {};
  const std::vector<PixelSample> as_given = SampleAgreement(RayScene(mesh), views, tolerance);
  for (Candidate& candidate : candidates)
    candidate.samples = SampleAgreement(RayScene(candidate.mesh), views, tolerance);
  candidates.erase(std::remove_if(candidates.begin(), candidates.end(),
                                  [&](Candidate& candidate) { return !Holds(as_given, candidate); }),
                   candidates.end());
  std::vector<MeshExplanation> explanations;
  for (const Candidate& candidate : candidates) {
    const bool is_refused = std::any_of(candidates.begin(), candidates.end(),
                                        [&](const Candidate& best) { return IsRefused(best, candidate); });
    if (is_refused) continue;
    explanations.push_back(candidate.explanation);
    // A mirrored tag map registers no view: of a mirror the mesh is to blame.
    MeshExplanation& e = explanations.back();
    if (!candidate.is_motion && !e.is_furniture_alone && e.right_from_given.linear().determinant() > 0)
      e.remedy += kMapInstead;
  }
  return explanations;
}

std::vector<MeshExplanation> MeshAsIfByTags(const Scene& mesh, const std::vector<SurveyedTag>& survey) {
  std::vector<MeshExplanation> explanations;
  if (survey.size() < kFewestTags || MissesOnlyTagsThatFaceUp(mesh, survey)) return explanations;
  int most = 0;
  for (const Candidate& candidate : CandidatesOf(mesh, survey)) {
    const MeshExplanation& e = candidate.explanation;
    if (e.is_furniture_alone || !IsMost(e.tags_on_mesh, survey.size()) || e.tags_on_mesh < most) continue;
    if (candidate.is_motion && !explanations.empty()) continue;
    if (e.tags_on_mesh > most) explanations.clear();
    most = e.tags_on_mesh;
    explanations.push_back(e);
    if (!candidate.is_motion) explanations.back().remedy += kMapInstead;
  }
  return explanations;
}

std::string NamesOf(const std::vector<MeshExplanation>& explanations) {
  std::string text;
  for (const MeshExplanation& e : explanations) text += (text.empty() ? "" : ", or ") + e.as_if;
  return text;
}

std::string InWords(const std::vector<MeshExplanation>& explanations) {
  std::string text = "the mesh looks " + NamesOf(explanations);
  if (explanations.size() > 1) text += ", which explain the photos equally";
  const MeshExplanation& e = explanations.front();
  text += fmt::format(": where the two differ, views agree on {:.0f} % of it so, and on {:.0f} % as given",
                      100 * e.agreement, 100 * e.agreement_as_given);
  if (e.tags_on_mesh == e.tags_on_mesh_as_given) return text;
  return text + fmt::format("; {} of {} surveyed tags lie on it so, and {} as given", e.tags_on_mesh, e.tags,
                            e.tags_on_mesh_as_given);
}

std::string RemedyOf(const std::vector<MeshExplanation>& explanations) {
  std::string text;
  for (const MeshExplanation& e : explanations) text += (text.empty() ? "" : "; or ") + e.remedy;
  return text;
}

}  // namespace luxfit
