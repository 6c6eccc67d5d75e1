// Tells which luminaires have a place by now, and which photos would give them one.
//
// A small sigma is not enough where the fit knew no place: linear design believes the light in one photo, which others
// explain as well from elsewhere. A luminaire has a place once photos of one state in which it shines were taken from
// two stands (inverse/observe/seen_luminaires.h). Without candidate photos the sigma alone counts.
//
// A photo shows bright panels without their names. Two luminaires that shine in one state can be exchanged while they
// have no place, unless they are dimmed alike in every state that is photographed: then it does not matter.
#ifndef LUXFIT_INVERSE_ADVISE_INTERNAL_PLACED_LUMINAIRES_H_
#define LUXFIT_INVERSE_ADVISE_INTERNAL_PLACED_LUMINAIRES_H_

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "inverse/advise/advise.h"
#include "inverse/advise/internal/prior_knowledge.h"

namespace luxfit {

class PlacedLuminaires {
 public:
  // Keeps references.
  PlacedLuminaires(const AdviceGiven& given, const PriorKnowledge& known);

  void Take(const PhotoCandidate& photo);
  // Takes over the sigmas of C = root root^T.
  void Update(const Eigen::MatrixXd& root);

  bool IsUnnamedIn(int state) const { return is_unnamed_[static_cast<size_t>(state)]; }
  // Returns how many luminaires the photo brings nearer to two stands.
  int StandsGained(const PhotoCandidate& photo) const;
  // Returns whether enough stands show the luminaire's light, with a further photo or null.
  bool HasStands(const std::string& luminaire, const PhotoCandidate* further) const;

 private:
  bool HasStands(int luminaire, const PhotoCandidate* further) const;
  // Returns the most stands with it in one state, with a further photo or null.
  size_t StandsOf(int luminaire, const PhotoCandidate* further) const;
  bool Shows(const PhotoCandidate& photo, int luminaire) const;
  // Returns whether the photo's stand is none of those.
  bool IsNewStand(const PhotoCandidate& photo, const std::vector<Eigen::Vector3d>& stands) const;
  bool AreAlike(int a, int b) const;
  Eigen::VectorXd SigmasOf(const Eigen::MatrixXd& root) const;

  const AdviceGiven& given_;
  const PriorKnowledge& known_;
  std::vector<int> photographed_;                       // states
  std::vector<bool> was_placed_;                        // by luminaire
  std::map<int, std::vector<Eigen::Vector3d>> stands_;  // of cameras, by state
  std::vector<bool> is_unnamed_;                        // by state
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ADVISE_INTERNAL_PLACED_LUMINAIRES_H_
