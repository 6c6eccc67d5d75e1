// `luxfit doctor`: what this machine has, and what a session still lacks, before any time is spent on a run.
//
// Returns 0 where nothing is wrong, 1 where something is that a run would stumble over. Throws as ReadSession
// does.
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
  std::string what, mend;  // no mend where there is nothing to do
};
std::vector<DoctorFinding> ExamineMachine();

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_DOCTOR_COMMAND_H_
