// Computes what candidates would tell, given the photos that were taken.
//
// A photo to come tells as much less than its rows as those that were taken did: their VarianceInflation divides it.
// An element counts once in each state, whatever view shows it; the outline of a luminaire once for each view.
#ifndef LUXFIT_INVERSE_ADVISE_INTERNAL_CANDIDATE_INFORMATION_H_
#define LUXFIT_INVERSE_ADVISE_INTERNAL_CANDIDATE_INFORMATION_H_

#include <Eigen/Core>
#include <set>
#include <utility>
#include <vector>

#include "inverse/advise/advise.h"
#include "inverse/advise/information.h"
#include "inverse/advise/internal/light_derivatives.h"
#include "inverse/advise/internal/prior_knowledge.h"

namespace luxfit {

class CandidateInformation {
 public:
  // Keeps references.
  CandidateInformation(const Room& room, const AdviceGiven& given, const PriorKnowledge& known);

  Eigen::MatrixXd OfPhoto(const PhotoCandidate& photo) const;
  Eigen::MatrixXd OfReading(size_t candidate) const;
  void TakePhoto(const PhotoCandidate& photo);
  void TakeReading(size_t candidate) { readings_[candidate].derivative.resize(0); }
  // Returns the derivative of the logarithm of a reading of `given.predicted`.
  Eigen::VectorXd DerivativeOfPredicted(size_t reading) const;

 private:
  // Information on the parameters of one luminaire.
  struct OutlinePart {
    int luminaire = 0;
    std::vector<Eigen::Index> parameters;
    Eigen::MatrixXd information;
  };

  std::vector<OutlinePart> OutlinesIn(const Room& room, const AdviceView& view) const;
  void MakePhotoRows(const Room& room);
  void MakeReadings();
  std::vector<PhotoRow> RowsOf(const PhotoCandidate& photo) const;
  bool IsNewOutline(const PhotoCandidate& photo, int luminaire) const;
  Eigen::MatrixXd Nothing() const;

  const AdviceGiven& given_;
  const PriorKnowledge& known_;
  const std::vector<int> sample_;  // of the room's elements
  const LightDerivatives light_;
  TakenRows taken_;
  double inflation_ = 1;                            // of the variance by photos
  std::vector<std::vector<int>> visible_;           // by view: places in sample_
  std::vector<std::vector<OutlinePart>> outlines_;  // by view
  std::vector<std::vector<PhotoRow>> rows_;         // by state, for each of sample_
  std::vector<RelativeRow> readings_;               // by candidate
  std::set<std::pair<int, int>> shown_;             // views and luminaires whose outlines were taken
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_ADVISE_INTERNAL_CANDIDATE_INFORMATION_H_
