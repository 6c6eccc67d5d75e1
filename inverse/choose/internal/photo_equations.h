// Gauss-Newton equations of radiometric self-calibration (inverse/choose/self_calibration.h), each element's own
// light eliminated.
//
//   z_i = (y_i(x) - ln (U_s B_e)) / (1 + q),   y = ln Y + q ln(Y t) - g - sum_k a_k r^2k
//   J = dz/dx,   A = - dz/dB
//   N = J'WJ - J'WA (A'WA)^-1 A'WJ
//
// z is in units of ln Y, as its noise is: residuals of ln R would vanish with q towards -1, where every count
// means the same light. U is a base of the states' dimmings, so that an element seen in few states has no
// more unknowns than it needs. B is at its optimum for x, so the gradient J'W z is that of the cost over x
// alone, exactly. Elements fall into folds by their patch; sums are kept fold by fold, so that fits without
// one need no further pass.
#ifndef LUXFIT_INVERSE_CHOOSE_INTERNAL_PHOTO_EQUATIONS_H_
#define LUXFIT_INVERSE_CHOOSE_INTERNAL_PHOTO_EQUATIONS_H_

#include <Eigen/Core>
#include <map>
#include <vector>

#include "inverse/choose/internal/left_out.h"
#include "inverse/choose/self_calibration.h"

namespace luxfit {

// Where each unknown stands in x; -1: held.
struct RadiometryUnknowns {
  std::vector<int> vignetting;  // first coefficient, one a camera
  std::vector<int> exponent;    // one a camera
  int first_gain = -1;
  int order = 0, count = 0;
};

class PhotoEquations {
 public:
  static constexpr int kFolds = 5;

  // Keeps the samples of elements that have more of them than light of their own, `max_elements` at most.
  PhotoEquations(const Patches& patches, const std::vector<Eigen::VectorXd>& dimming,
                 const std::vector<PhotoSample>& samples, int max_elements);

  int elements() const { return static_cast<int>(elements_.size()); }
  int rows() const { return static_cast<int>(rows_.size()); }
  // Error that all samples have beside their own, added in squares.
  void set_common_sigma(double sigma) { common_sigma_ = sigma; }

  struct Fit {
    Eigen::VectorXd x;
    Eigen::MatrixXd light;   // B, a column an element
    Eigen::VectorXd weight;  // robust, by row
    double scale = 1;        // of residuals in sigmas, robust
    double sigma = 0;        // of residuals, robust, freedom allowed for
  };
  // Light of its own for every element, everything as recorded, no robust weights yet.
  Fit Start(const RadiometryUnknowns& unknowns) const;

  struct Sums {
    Eigen::MatrixXd normal;
    Eigen::VectorXd right;  // - gradient
    double cost = 0;        // half the weighted squares
  };
  // By fold; B is brought to its optimum for fit.x first.
  std::vector<Sums> Linearize(const RadiometryUnknowns& unknowns, Fit& fit) const;

  // Robust weights, scale and sigma from the residuals.
  void Reweigh(const RadiometryUnknowns& unknowns, Fit& fit) const;

  // Of the elements of a fold by facet, B fitted to themselves with x held.
  GroupScores Score(const RadiometryUnknowns& unknowns, const Fit& fit, const Eigen::VectorXd& x,
                    int fold) const;

  // - gradient by facet (by patch, in rooms of few facets): what covariance is told from.
  std::map<int, Eigen::VectorXd> GradientByGroup(const RadiometryUnknowns& unknowns, const Fit& fit) const;

 private:
  struct ElementRows {
    int first = 0, count = 0;
    int fold = 0, group = 0;
    Eigen::MatrixXd base;      // U of its rows
    std::vector<int> cameras;  // those that see it
  };
  const PhotoSample& RowOf(const ElementRows& element, int i) const;
  // y of the rows of one element.
  Eigen::VectorXd Corrected(const RadiometryUnknowns& unknowns, const Eigen::VectorXd& x,
                            const ElementRows& element) const;
  // 1 / (1 + q) of each row.
  Eigen::VectorXd Power(const RadiometryUnknowns& unknowns, const Eigen::VectorXd& x,
                        const ElementRows& element) const;
  Eigen::VectorXd Weights(const Fit& fit, const ElementRows& element) const;
  std::vector<int> UnknownsOf(const RadiometryUnknowns& unknowns, const ElementRows& element) const;
  // (1 + q) dz/dx, a row a sample.
  Eigen::MatrixXd Derivatives(const RadiometryUnknowns& unknowns, const ElementRows& element,
                              const std::vector<int>& unknown, const Eigen::VectorXd& scaled_residual) const;
  void AddElement(const RadiometryUnknowns& unknowns, const Fit& fit, Eigen::Index index, Sums& sums) const;

  std::vector<PhotoSample> rows_;  // element by element
  std::vector<ElementRows> elements_;
  Eigen::MatrixXd base_;  // U, states x rank
  double common_sigma_ = 0.01;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_CHOOSE_INTERNAL_PHOTO_EQUATIONS_H_
