// Builds the Gauss-Newton equations of radiometric self-calibration, each element's own light eliminated.
//
//   z_i = (y_i(x) - ln (U_s B_e)) / (1 + q),   y = ln Y + q ln(Y t) - h - g - sum_k a_k r^2k
//   J = dz/dx,   A = - dz/dB
//   N = J'WJ - J'WA (A'WA)^-1 A'WJ
//
// Symbols are those of inverse/observe/camera/self_calibration.h. z is in units of ln Y, as its noise is. Residuals
// of ln R would vanish as q goes to -1, where every count means the same light. U is a base of the states'
// dimmings, so that an element seen in few states has no more unknowns than it needs. B is at its optimum for
// x, so the gradient J'W z is exactly that of the cost over x alone.
//
// Elements fall into folds by their patch. Sums are kept fold by fold, so that fits without one fold need no
// further pass.
#ifndef LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_RADIOMETRY_PHOTO_EQUATIONS_H_
#define LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_RADIOMETRY_PHOTO_EQUATIONS_H_

#include <Eigen/Core>
#include <map>
#include <set>
#include <vector>

#include "inverse/observe/camera/self_calibration.h"
#include "inverse/select/one_standard_error.h"

namespace luxfit {

// Maps each unknown to its index in x; -1: held.
struct RadiometryUnknowns {
  std::vector<int> vignetting;  // index of the first coefficient, one for each camera
  std::vector<int> exponent;    // one for each camera
  std::vector<int> camera;      // gain of the camera, one for each
  int first_gain = -1;
  int order = 0, count = 0;
};

class PhotoEquations {
 public:
  static constexpr int kFolds = 5;

  // Keeps the elements that have more samples than unknowns of their own light: about `max_elements`, evenly
  // over the sets of cameras that see them, so that a small overlap of two cameras is not thinned away.
  PhotoEquations(const Patches& patches, const std::vector<Eigen::VectorXd>& dimming,
                 const std::vector<PhotoSample>& samples, int max_elements);

  int elements() const { return static_cast<int>(elements_.size()); }
  int rows() const { return static_cast<int>(rows_.size()); }
  // Sets an error that all samples have beside their own, added in squares.
  void set_common_sigma(double sigma) { common_sigma_ = sigma; }

  struct Fit {
    Eigen::VectorXd x;
    Eigen::MatrixXd light;   // B, one column for each element
    Eigen::VectorXd weight;  // robust, by row
    double scale = 1;        // robust scale of residuals, in sigmas
    double sigma = 0;        // robust sigma of residuals, corrected for degrees of freedom
  };
  // Returns a start: light of its own for every element, everything as recorded, no robust weights.
  Fit Start(const RadiometryUnknowns& unknowns) const;

  struct Sums {
    Eigen::MatrixXd normal;
    Eigen::VectorXd right;  // - gradient
    double cost = 0;        // half the weighted squares
  };
  // Returns the sums by fold. It first brings B to its optimum for fit.x.
  std::vector<Sums> Linearize(const RadiometryUnknowns& unknowns, Fit& fit) const;

  // Sets robust weights, scale and sigma from the residuals.
  void Reweigh(const RadiometryUnknowns& unknowns, Fit& fit) const;

  // Scores the elements of a fold by facet, with x held and their B fitted.
  GroupScores Score(const RadiometryUnknowns& unknowns, const Fit& fit, const Eigen::VectorXd& x,
                    int fold) const;

  // Returns - gradient by facet (by patch, where the elements lie on few facets), for the covariance.
  std::map<int, Eigen::VectorXd> GradientByGroup(const RadiometryUnknowns& unknowns, const Fit& fit) const;

 private:
  struct ElementRows {
    int first = 0, count = 0;
    int fold = 0, group = 0;
    Eigen::MatrixXd base;      // rows of U for its samples
    std::vector<int> cameras;  // cameras that see it
  };
  void AddRows(const std::vector<PhotoSample>& of_element, const std::set<int>& cameras, int fold, int group);
  const PhotoSample& RowOf(const ElementRows& element, int i) const;
  // Returns y for the rows of one element.
  Eigen::VectorXd Corrected(const RadiometryUnknowns& unknowns, const Eigen::VectorXd& x,
                            const ElementRows& element) const;
  // Returns 1 / (1 + q) for each row.
  Eigen::VectorXd Power(const RadiometryUnknowns& unknowns, const Eigen::VectorXd& x,
                        const ElementRows& element) const;
  Eigen::VectorXd Weights(const Fit& fit, const ElementRows& element) const;
  std::vector<int> UnknownsOf(const RadiometryUnknowns& unknowns, const ElementRows& element) const;
  // Returns (1 + q) dz/dx, one row for each sample.
  Eigen::MatrixXd Derivatives(const RadiometryUnknowns& unknowns, const ElementRows& element,
                              const std::vector<int>& unknown, const Eigen::VectorXd& scaled_residual) const;
  void AddElement(const RadiometryUnknowns& unknowns, const Fit& fit, Eigen::Index index, Sums& sums) const;

  std::vector<PhotoSample> rows_;  // element by element
  std::vector<ElementRows> elements_;
  Eigen::MatrixXd base_;  // U, states x rank
  double common_sigma_ = 0.01;
};

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_CAMERA_INTERNAL_RADIOMETRY_PHOTO_EQUATIONS_H_
