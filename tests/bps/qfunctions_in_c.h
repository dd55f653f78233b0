/// @file
/// Every QFunction of qfunctions/bps and qfunctions/gallery, in one order, as the language of the including file makes
/// them. The C11 table is compared with the C++20 one.
#pragma once

#include "qfunctions/bps/manufactured.h"
#include "qfunctions/bps/mass.h"
#include "qfunctions/bps/poisson.h"
#include "qfunctions/gallery/identity.h"
#include "qfunctions/gallery/identity_to_scalar.h"
#include "qfunctions/gallery/mass1d_build.h"
#include "qfunctions/gallery/mass2d_build.h"
#include "qfunctions/gallery/mass3d_build.h"
#include "qfunctions/gallery/mass_apply.h"
#include "qfunctions/gallery/poisson1d_apply.h"
#include "qfunctions/gallery/poisson1d_build.h"
#include "qfunctions/gallery/poisson2d_apply.h"
#include "qfunctions/gallery/poisson2d_build.h"
#include "qfunctions/gallery/poisson3d_apply.h"
#include "qfunctions/gallery/poisson3d_build.h"
#include "qfunctions/gallery/scale.h"
#include "qfunctions/gallery/scale_scalar.h"
#include "qfunctions/gallery/vector3_mass_apply.h"
#include "qfunctions/gallery/vector3_poisson1d_apply.h"
#include "qfunctions/gallery/vector3_poisson2d_apply.h"
#include "qfunctions/gallery/vector3_poisson3d_apply.h"

typedef int (*AnyQFunction)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out);

/// A QFunction, and whether its context is a BPSolution (else the number of components).
typedef struct {
  const char *name;
  AnyQFunction function;
  bool takes_solution;
} NamedQFunction;

/// The table in this language; a null name ends it.
static const NamedQFunction all_qfunctions[] = {
    {"BPMassSetup", BPMassSetup, false},
    {"BPMassApply", BPMassApply, false},
    {"BPMassApply3", BPMassApply3, false},
    {"BPPoissonSetup", BPPoissonSetup, false},
    {"BPPoissonApply", BPPoissonApply, false},
    {"BPPoissonApply3", BPPoissonApply3, false},
    {"BPMassSource", BPMassSource, true},
    {"BPPoissonSource", BPPoissonSource, true},
    {"BPPoissonFlux", BPPoissonFlux, true},
    {"BPError", BPError, true},
    {"Identity", Identity, false},
    {"IdentityScalar", IdentityScalar, false},
    {"Mass1DBuild", Mass1DBuild, false},
    {"Mass2DBuild", Mass2DBuild, false},
    {"Mass3DBuild", Mass3DBuild, false},
    {"MassApply", MassApply, false},
    {"Poisson1DApply", Poisson1DApply, false},
    {"Poisson1DBuild", Poisson1DBuild, false},
    {"Poisson2DApply", Poisson2DApply, false},
    {"Poisson2DBuild", Poisson2DBuild, false},
    {"Poisson3DApply", Poisson3DApply, false},
    {"Poisson3DBuild", Poisson3DBuild, false},
    {"Scale", Scale, false},
    {"ScaleScalar", ScaleScalar, false},
    {"Vector3MassApply", Vector3MassApply, false},
    {"Vector3Poisson1DApply", Vector3Poisson1DApply, false},
    {"Vector3Poisson2DApply", Vector3Poisson2DApply, false},
    {"Vector3Poisson3DApply", Vector3Poisson3DApply, false},
    {NULL, NULL, false},
};

#ifdef __cplusplus
extern "C" {
#endif

/// The table that the C compiler made.
const NamedQFunction *qfunctions_in_c(void);

#ifdef __cplusplus
}
#endif
