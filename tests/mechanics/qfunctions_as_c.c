// The QFunction headers are C: this file compiles every one of them as C11, for materials_qfunctions_test.
#include <ceed.h>

#include "qfunctions/bc/body_force.h"
#include "qfunctions/bc/mms_linear.h"
#include "qfunctions/common/geometry.h"
#include "qfunctions/common/integrals.h"
#include "qfunctions/materials/linear.h"
#include "qfunctions/materials/neo_hookean_current.h"
#include "qfunctions/materials/neo_hookean_initial.h"
#include "qfunctions/mpm/geometry_points.h"
#include "qfunctions/mpm/point_update.h"

typedef struct {
  CeedQFunctionUser function;
  const char *source;
} NamedQFunction;

const NamedQFunction qfunctions_as_c[] = {
    {HgBodyForce, HgBodyForce_loc},
    {HgMmsLinearForce, HgMmsLinearForce_loc},
    {HgMmsLinearError, HgMmsLinearError_loc},
    {HgGeometry, HgGeometry_loc},
    {HgGeometryPoints, HgGeometryPoints_loc},
    {HgMass, HgMass_loc},
    {HgCopy, HgCopy_loc},
    {HgWeight, HgWeight_loc},
    {HgIntegrals, HgIntegrals_loc},
    {HgLinearResidual, HgLinearResidual_loc},
    {HgLinearJacobian, HgLinearJacobian_loc},
    {HgLinearEnergy, HgLinearEnergy_loc},
    {HgLinearDiagnostic, HgLinearDiagnostic_loc},
    {HgNeoHookeanEnergy, HgNeoHookeanEnergy_loc},
    {HgNeoHookeanDiagnostic, HgNeoHookeanDiagnostic_loc},
    {HgNeoHookeanInitialResidual, HgNeoHookeanInitialResidual_loc},
    {HgNeoHookeanInitialJacobian, HgNeoHookeanInitialJacobian_loc},
    {HgNeoHookeanCurrentResidual, HgNeoHookeanCurrentResidual_loc},
    {HgNeoHookeanCurrentJacobian, HgNeoHookeanCurrentJacobian_loc},
    {HgPointUpdate, HgPointUpdate_loc},
};
const CeedInt num_qfunctions_as_c = sizeof(qfunctions_as_c) / sizeof(qfunctions_as_c[0]);
