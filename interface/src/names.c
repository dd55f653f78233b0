// Names of the enumerations' values. C, for its array designators: programs hold copies of these arrays, so they must
// be there before any code of the library runs, and the table of topologies has a place for every value below 0x30007.
#include <ceed/backend.h>

static const char *const error_types[] = {
    [CEED_ERROR_UNSUPPORTED + 3] = "operation unsupported by backend",
    [CEED_ERROR_BACKEND + 3] = "internal backend error",
    [CEED_ERROR_MAJOR + 3] = "generic major error",
    [CEED_ERROR_SUCCESS + 3] = "success",
    [CEED_ERROR_MINOR + 3] = "generic minor error",
    [CEED_ERROR_DIMENSION + 3] = "dimension mismatch",
    [CEED_ERROR_INCOMPLETE + 3] = "object setup incomplete",
    [CEED_ERROR_INCOMPATIBLE + 3] = "incompatible arguments",
    [CEED_ERROR_ACCESS + 3] = "access lock in use",
};
const char *const *CeedErrorTypes = &error_types[3];

const char *const CeedMemTypes[] = {
    [CEED_MEM_HOST] = "host",
    [CEED_MEM_DEVICE] = "device",
};

const char *const CeedCopyModes[] = {
    [CEED_COPY_VALUES] = "copy values",
    [CEED_USE_POINTER] = "use pointer",
    [CEED_OWN_POINTER] = "own pointer",
};

const char *const CeedTransposeModes[] = {
    [CEED_NOTRANSPOSE] = "no transpose",
    [CEED_TRANSPOSE] = "transpose",
};

const char *const CeedEvalModes[] = {
    [CEED_EVAL_NONE] = "none",     [CEED_EVAL_INTERP] = "interpolation",
    [CEED_EVAL_GRAD] = "gradient", [CEED_EVAL_DIV] = "divergence",
    [CEED_EVAL_CURL] = "curl",     [CEED_EVAL_WEIGHT] = "quadrature weights",
};

const char *const CeedQuadModes[] = {
    [CEED_GAUSS] = "Gauss",
    [CEED_GAUSS_LOBATTO] = "Gauss Lobatto",
};

const char *const CeedElemTopologies[] = {
    [CEED_TOPOLOGY_LINE] = "line",       [CEED_TOPOLOGY_TRIANGLE] = "triangle", [CEED_TOPOLOGY_QUAD] = "quadrilateral",
    [CEED_TOPOLOGY_TET] = "tetrahedron", [CEED_TOPOLOGY_PYRAMID] = "pyramid",   [CEED_TOPOLOGY_PRISM] = "prism",
    [CEED_TOPOLOGY_HEX] = "hexahedron",
};

const char *const CeedContextFieldTypes[] = {
    [CEED_CONTEXT_FIELD_DOUBLE] = "double",
    [CEED_CONTEXT_FIELD_INT32] = "int32",
    [CEED_CONTEXT_FIELD_BOOL] = "bool",
};

const char *const CeedFESpaces[] = {
    [CEED_FE_SPACE_H1] = "H^1 space",
    [CEED_FE_SPACE_HDIV] = "H(div) space",
    [CEED_FE_SPACE_HCURL] = "H(curl) space",
};
