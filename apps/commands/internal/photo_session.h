// Makes a session of photos of a board, for `luxfit calibrate` without a session file.
//
// The photos of one folder are one camera, called as the folder is. Photos of a single folder are several cameras where
// the parts of their names before the number tell: left01.jpg, right01.jpg, ... are two that took three photos or more
// together. Cameras that pair up by no name or number, and have equally many photos, pair up by order.
#ifndef LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_SESSION_H_
#define LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_SESSION_H_

#include <string>
#include <vector>

#include "apps/session/session.h"

namespace luxfit {

// Tells whether the inputs of the command stand for a session: a single one that is no photo and no folder. A folder that
// holds a session.toml does so, too, where no board is given.
bool IsSessionFile(const std::vector<std::string>& inputs, const std::string& board);

// `inputs` are photos and folders; `board` is as in apps/stages/calibrate/board_text.h, `rig` one of RigRules or empty.
// Throws std::runtime_error for a missing file, a folder without photos, a session among photos and a text that is no
// board.
Session SessionOfPhotos(const std::vector<std::string>& inputs, const std::string& board,
                        const std::string& rig);

}  // namespace luxfit

#endif  // LUXFIT_APPS_COMMANDS_INTERNAL_PHOTO_SESSION_H_
