#include "gallery.h"

#include "identity.h"
#include "identity_to_scalar.h"
#include "mass1d_build.h"
#include "mass2d_build.h"
#include "mass3d_build.h"
#include "mass_apply.h"
#include "poisson1d_apply.h"
#include "poisson1d_build.h"
#include "poisson2d_apply.h"
#include "poisson2d_build.h"
#include "poisson3d_apply.h"
#include "poisson3d_build.h"
#include "scale.h"
#include "scale_scalar.h"
#include "vector3_mass_apply.h"
#include "vector3_poisson1d_apply.h"
#include "vector3_poisson2d_apply.h"
#include "vector3_poisson3d_apply.h"

// clang-format off
const HgGalleryEntry hg_gallery[] = {
    {"Mass1DBuild", Mass1DBuild, "gallery/mass1d_build.h:Mass1DBuild", 1, 2, 1,
     {{"dx", 1, CEED_EVAL_GRAD}, {"weights", 1, CEED_EVAL_WEIGHT}}, {{"qdata", 1, CEED_EVAL_NONE}}, false},
    {"Mass2DBuild", Mass2DBuild, "gallery/mass2d_build.h:Mass2DBuild", 2, 2, 1,
     {{"dx", 4, CEED_EVAL_GRAD}, {"weights", 1, CEED_EVAL_WEIGHT}}, {{"qdata", 1, CEED_EVAL_NONE}}, false},
    {"Mass3DBuild", Mass3DBuild, "gallery/mass3d_build.h:Mass3DBuild", 3, 2, 1,
     {{"dx", 9, CEED_EVAL_GRAD}, {"weights", 1, CEED_EVAL_WEIGHT}}, {{"qdata", 1, CEED_EVAL_NONE}}, false},
    {"MassApply", MassApply, "gallery/mass_apply.h:MassApply", 0, 2, 1,
     {{"u", 1, CEED_EVAL_INTERP}, {"qdata", 1, CEED_EVAL_NONE}}, {{"v", 1, CEED_EVAL_INTERP}}, false},
    {"Vector3MassApply", Vector3MassApply, "gallery/vector3_mass_apply.h:Vector3MassApply", 0, 2, 1,
     {{"u", 3, CEED_EVAL_INTERP}, {"qdata", 1, CEED_EVAL_NONE}}, {{"v", 3, CEED_EVAL_INTERP}}, false},
    {"Poisson1DBuild", Poisson1DBuild, "gallery/poisson1d_build.h:Poisson1DBuild", 1, 2, 1,
     {{"dx", 1, CEED_EVAL_GRAD}, {"weights", 1, CEED_EVAL_WEIGHT}}, {{"qdata", 1, CEED_EVAL_NONE}}, false},
    {"Poisson2DBuild", Poisson2DBuild, "gallery/poisson2d_build.h:Poisson2DBuild", 2, 2, 1,
     {{"dx", 4, CEED_EVAL_GRAD}, {"weights", 1, CEED_EVAL_WEIGHT}}, {{"qdata", 3, CEED_EVAL_NONE}}, false},
    {"Poisson3DBuild", Poisson3DBuild, "gallery/poisson3d_build.h:Poisson3DBuild", 3, 2, 1,
     {{"dx", 9, CEED_EVAL_GRAD}, {"weights", 1, CEED_EVAL_WEIGHT}}, {{"qdata", 6, CEED_EVAL_NONE}}, false},
    {"Poisson1DApply", Poisson1DApply, "gallery/poisson1d_apply.h:Poisson1DApply", 1, 2, 1,
     {{"du", 1, CEED_EVAL_GRAD}, {"qdata", 1, CEED_EVAL_NONE}}, {{"dv", 1, CEED_EVAL_GRAD}}, false},
    {"Poisson2DApply", Poisson2DApply, "gallery/poisson2d_apply.h:Poisson2DApply", 2, 2, 1,
     {{"du", 2, CEED_EVAL_GRAD}, {"qdata", 3, CEED_EVAL_NONE}}, {{"dv", 2, CEED_EVAL_GRAD}}, false},
    {"Poisson3DApply", Poisson3DApply, "gallery/poisson3d_apply.h:Poisson3DApply", 3, 2, 1,
     {{"du", 3, CEED_EVAL_GRAD}, {"qdata", 6, CEED_EVAL_NONE}}, {{"dv", 3, CEED_EVAL_GRAD}}, false},
    {"Vector3Poisson1DApply", Vector3Poisson1DApply, "gallery/vector3_poisson1d_apply.h:Vector3Poisson1DApply", 1, 2, 1,
     {{"du", 3, CEED_EVAL_GRAD}, {"qdata", 1, CEED_EVAL_NONE}}, {{"dv", 3, CEED_EVAL_GRAD}}, false},
    {"Vector3Poisson2DApply", Vector3Poisson2DApply, "gallery/vector3_poisson2d_apply.h:Vector3Poisson2DApply", 2, 2, 1,
     {{"du", 6, CEED_EVAL_GRAD}, {"qdata", 3, CEED_EVAL_NONE}}, {{"dv", 6, CEED_EVAL_GRAD}}, false},
    {"Vector3Poisson3DApply", Vector3Poisson3DApply, "gallery/vector3_poisson3d_apply.h:Vector3Poisson3DApply", 3, 2, 1,
     {{"du", 9, CEED_EVAL_GRAD}, {"qdata", 6, CEED_EVAL_NONE}}, {{"dv", 9, CEED_EVAL_GRAD}}, false},
    {.name = "Identity", .function = Identity, .source = "gallery/identity.h:Identity", .takes_num_comp = true},
    {.name = "Identity to scalar", .function = IdentityScalar, .source = "gallery/identity_to_scalar.h:IdentityScalar",
     .takes_num_comp = true},
    {.name = "Scale", .function = Scale, .source = "gallery/scale.h:Scale", .takes_num_comp = true},
    {.name = "Scale (scalar)", .function = ScaleScalar, .source = "gallery/scale_scalar.h:ScaleScalar",
     .takes_num_comp = true},
    {.name = NULL},
};
// clang-format on
