// Finds how a mesh lies otherwise than the room that photos show: mirrored, turned, shifted, its axes exchanged.
//
//   agreement = share of pixels with the same signature in other views, where the mesh puts them
//               of the pixels that two meshes put at different places    inverse/furniture/internal/sampled_agreement.h
//
// Only the room's own surfaces are seen alike from everywhere, so no light is fitted. The explanations are those of
// forward/changes/frame_mistakes.h, of the whole mesh or of its furniture alone, and the rigid motion that lays the surveyed
// tags on the mesh (calib/register/mesh_alignment.h). No fewer tags may lie on the mesh than as given.
//
// A frame mistake holds where it more than doubles the agreement, by more than two standard errors (the rule of
// inverse/select/contradicted.h), and a tenth of the pixels agree. A motion holds where nine tenths of the tags lie
// on the mesh so and not as given, one of them moves by 2 cm or more, and agreement rises by more than two standard
// errors. Explanations that the best one does not exceed by as much are returned beside it: they explain the
// photos equally.
//
// Photos tell where the mesh lies in the frame of the tags. A mirror is the mesh's: a mirrored tag map registers no view.
// A motion or a turn may be the mesh's or the tag map's: photos do not tell which. Metres, world frame. Source: own.
#ifndef LUXFIT_INVERSE_OBSERVE_AS_IF_MESH_AS_IF_H_
#define LUXFIT_INVERSE_OBSERVE_AS_IF_MESH_AS_IF_H_

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "calib/targets/tags.h"
#include "forward/room/scene.h"
#include "inverse/furniture/signature_view.h"

namespace luxfit {

struct MeshExplanation {
  std::string as_if;                 // completes "the mesh looks ..."
  std::string remedy;                // a clause without a full stop
  Eigen::Affine3d right_from_given;  // maps the mesh as given, or its furniture, to where it would be
  bool is_furniture_alone = false;
  double agreement_as_given = 0, agreement = 0;     // of the pixels where both differ; 0 by tags alone
  int tags_on_mesh_as_given = 0, tags_on_mesh = 0;  // surveyed tags within 1 cm of it
  int tags = 0;                                     // surveyed
};

// Views have the same states. Returns the explanations that hold, the best first. `tolerance`: of signatures, as
// FurnitureOptions has it. Fewer than three views find nothing.
std::vector<MeshExplanation> FindMeshAsIf(const Scene& mesh, const std::vector<SignatureView>& views,
                                          const std::vector<SurveyedTag>& survey, double tolerance = 0.015);

// Returns what would lay nine tenths of the surveyed tags on a mesh that most of them miss, without any photo: those
// with most tags on it, the motion only where no frame mistake does. Nothing for fewer
// than four tags, or where all that the mesh misses face up: it may lack the desks on which they lie.
std::vector<MeshExplanation> MeshAsIfByTags(const Scene& mesh, const std::vector<SurveyedTag>& survey);

// Returns what completes "the mesh looks ..." of all.
std::string NamesOf(const std::vector<MeshExplanation>& explanations);

// Says in one sentence, without a full stop, what explains the photos. `explanations`: one or more.
std::string InWords(const std::vector<MeshExplanation>& explanations);

// Returns the remedies of all, as one clause without a full stop.
std::string RemedyOf(const std::vector<MeshExplanation>& explanations);

}  // namespace luxfit

#endif  // LUXFIT_INVERSE_OBSERVE_AS_IF_MESH_AS_IF_H_
