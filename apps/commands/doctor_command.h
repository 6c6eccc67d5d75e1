// Runs `luxfit doctor`: reports what this machine has and what a session still lacks, before a run takes any
// time.
//
// Returns 0 where nothing is wrong, and 1 where something would make a run fail. Throws as ReadSession does.
#ifndef LUXFIT_APPS_COMMANDS_DOCTOR_COMMAND_H_
#define LUXFIT_APPS_COMMANDS_DOCTOR_COMMAND_H_

#include <string>
#include <vector>

namespace luxfit {

struct DoctorCommandOptions {
  std::string session;  // empty: the machine alone
  bool json = false;
};
int DoctorCommand(const DoctorCommandOptions& options);

enum class Health { kGood, kNote, kBad };  // a note costs accuracy or an answer, not the run
struct DoctorFinding {
  Health health = Health::kGood;
  std::string what, remedy;  // `remedy` is empty where there is nothing to do
};
std::vector<DoctorFinding> ExamineMachine();

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_DOCTOR_COMMAND_H_
