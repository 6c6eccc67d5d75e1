// Runs `luxfit dim OUT --person ...`: finds the luminaires that can be dimmed unseen by the people present.
//
// Writes dim.json, luminaires.csv and persons.csv, whose columns docs/commands.md describes.
//
// Returns the exit status: 0, or 1 where no luminaire's light is known to reach an eye. Throws
// std::runtime_error for bad input.
#ifndef LUXFIT_APPS_COMMANDS_RESULT_DIM_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_RESULT_DIM_COMMAND_H_

#include <string>
#include <vector>

namespace luxfit {

struct DimCommandOptions {
  std::string out;  // folder of the run
  // "x,y,z,dx,dy,dz", a .toml of [[observer]] id, eye_m, looking, or a .csv id,x_m,y_m,z_m,dx,dy,dz
  std::vector<std::string> persons;
  double drop_percent = 10;
  std::string state;            // what is on now; empty: the state with the most on
  std::string design;           // for its [power_w]; empty: power goes with the flux
  std::string session, folder;  // folder empty: OUT/dim
  std::string command_line;
  bool json = false;
};

int DimCommand(const DimCommandOptions& options);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_RESULT_DIM_COMMAND_H_
