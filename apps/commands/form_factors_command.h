// Runs `luxfit formfactors`: writes the form factors between the patches of a mesh, by any method, to a file.
//
// CSV: one row for each patch, with its facet, material, area (m2), centre (m), and its form factors to all
// patches. JSON: the same with provenance, measures of closure and reciprocity, rays and time.
//
// Throws std::runtime_error for bad input (exit status 2).
// Source: docs/session-format.md, "Commands".
#ifndef LUXFIT_APPS_COMMANDS_FORM_FACTORS_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_FORM_FACTORS_COMMAND_H_

#include <string>

namespace luxfit {

struct FormFactorsCommandOptions {
  std::string mesh;
  std::string file;  // .csv or .json
  std::string method = "hybrid";
  int rays = 256;  // per patch
  double patch_size_m = 0.5;
  std::string unit = "m";
  std::string command_line;
  bool json = false;  // print the summary as JSON
};

int FormFactorsCommand(const FormFactorsCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_FORM_FACTORS_COMMAND_H_
