#include "inverse/advise/internal/placed_luminaires.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace luxfit {
namespace {

constexpr size_t kStandsOfPlace = 2;
constexpr double kBaselineM = 0.5;

}  // namespace

PlacedLuminaires::PlacedLuminaires(const AdviceGiven& given, const PriorKnowledge& known)
    : given_(given), known_(known) {
  std::set<int> states;
  for (const PhotoCandidate& photo : given.taken) states.insert(photo.state);
  for (const PhotoCandidate& photo : given.photos) states.insert(photo.state);
  photographed_.assign(states.begin(), states.end());
  is_unnamed_.assign(given.dimming.size(), false);
  const Eigen::VectorXd variances = known.covariance.diagonal();
  const Eigen::VectorXd sigmas = SigmasOf(variances.cwiseSqrt().asDiagonal());
  for (const double sigma : sigmas) was_placed_.push_back(given.photos.empty() || IsKnownSigma(sigma));
  for (const PhotoCandidate& photo : given.taken) Take(photo);
}

Eigen::VectorXd PlacedLuminaires::SigmasOf(const Eigen::MatrixXd& root) const {
  Eigen::VectorXd variances = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(given_.luminaires.size()));
  for (size_t p = 0; p < known_.parameters.size(); ++p) {
    const Parameter& parameter = known_.parameters[p];
    if (parameter.kind == ParameterKind::kLuminaire && parameter.quantity <= LuminaireQuantity::kPositionZ)
      variances[parameter.index] += root.row(static_cast<Eigen::Index>(p)).squaredNorm();
  }
  return variances.cwiseSqrt();
}

bool PlacedLuminaires::Shows(const PhotoCandidate& photo, int luminaire) const {
  return given_.dimming[static_cast<size_t>(photo.state)][luminaire] > 0;
}

bool PlacedLuminaires::IsNewStand(const PhotoCandidate& photo,
                                  const std::vector<Eigen::Vector3d>& stands) const {
  const Eigen::Vector3d eye =
      given_.views[static_cast<size_t>(photo.view)].cam_from_world.inverse().translation();
  return std::all_of(stands.begin(), stands.end(),
                     [&](const Eigen::Vector3d& stand) { return (stand - eye).norm() >= kBaselineM; });
}

void PlacedLuminaires::Take(const PhotoCandidate& photo) {
  std::vector<Eigen::Vector3d>& stands = stands_[photo.state];
  if (IsNewStand(photo, stands))
    stands.push_back(given_.views[static_cast<size_t>(photo.view)].cam_from_world.inverse().translation());
}

size_t PlacedLuminaires::StandsOf(int luminaire, const PhotoCandidate* further) const {
  size_t most = further != nullptr && Shows(*further, luminaire) ? 1 : 0;
  for (const auto& [state, stands] : stands_) {
    if (!(given_.dimming[static_cast<size_t>(state)][luminaire] > 0)) continue;
    const bool is_further = further != nullptr && further->state == state && IsNewStand(*further, stands);
    most = std::max(most, stands.size() + (is_further ? 1 : 0));
  }
  return most;
}

bool PlacedLuminaires::HasStands(int luminaire, const PhotoCandidate* further) const {
  return was_placed_[static_cast<size_t>(luminaire)] || StandsOf(luminaire, further) >= kStandsOfPlace;
}

bool PlacedLuminaires::HasStands(const std::string& luminaire, const PhotoCandidate* further) const {
  const auto at = std::find_if(given_.luminaires.begin(), given_.luminaires.end(),
                               [&](const Luminaire& l) { return l.id == luminaire; });
  return at == given_.luminaires.end() ||
         HasStands(static_cast<int>(at - given_.luminaires.begin()), further);
}

int PlacedLuminaires::StandsGained(const PhotoCandidate& photo) const {
  int gained = 0;
  for (int k = 0; k < static_cast<int>(given_.luminaires.size()); ++k) {
    if (!HasStands(k, nullptr) && StandsOf(k, &photo) > StandsOf(k, nullptr)) ++gained;
  }
  return gained;
}

bool PlacedLuminaires::AreAlike(int a, int b) const {
  return std::all_of(photographed_.begin(), photographed_.end(), [&](int state) {
    const Eigen::VectorXd& dimming = given_.dimming[static_cast<size_t>(state)];
    return dimming[a] == dimming[b];
  });
}

void PlacedLuminaires::Update(const Eigen::MatrixXd& root) {
  const Eigen::VectorXd sigmas = SigmasOf(root);
  for (const int state : photographed_) {
    const Eigen::VectorXd& dimming = given_.dimming[static_cast<size_t>(state)];
    std::vector<int> unplaced;
    for (int k = 0; k < static_cast<int>(dimming.size()); ++k) {
      if (dimming[k] > 0 && !(IsKnownSigma(sigmas[k]) && HasStands(k, nullptr))) unplaced.push_back(k);
    }
    is_unnamed_[static_cast<size_t>(state)] =
        std::any_of(unplaced.begin(), unplaced.end(), [&](int k) { return !AreAlike(unplaced.front(), k); });
  }
}

}  // namespace luxfit
