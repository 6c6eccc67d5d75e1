#include "forward/factors/form_factors.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "forward/factors/internal/methods.h"

namespace luxfit {

const std::vector<FormFactorOps>& FormFactorMethods() {
  static const std::vector<FormFactorOps> methods = {
      HybridMethod(),     AnalyticMethod(), MalleyMethod(),      MalleyStratifiedMethod(), IsocellMethod(),
      MonteCarloMethod(), HemicubeMethod(), SinglePlaneMethod(), WallaceMethod(),
  };
  return methods;
}

const FormFactorOps& OpsOf(FormFactorMethod method) {
  const auto& methods = FormFactorMethods();
  const auto row = std::find_if(methods.begin(), methods.end(),
                                [method](const FormFactorOps& ops) { return ops.method == method; });
  if (row == methods.end())
    throw std::invalid_argument("OpsOf: expected a method of FormFactorMethods(), got value " +
                                std::to_string(static_cast<int>(method)));
  return *row;
}

}  // namespace luxfit
