/* A backend outside of the tree: it gathers elements with a loop of its own and leaves the rest to the reference. */
#include <ceed/plugin.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The tables as the parent filled them: what we replace in ours, we can still call. */
static CeedBackendOps parent;

/* What one Ceed keeps. */
typedef struct {
  CeedSize num_gathered; /* values gathered by our loop */
  bool is_counting;      /* say so at the end */
} Counter;

/* Whether the loop below can do it: one offset for each node, no signs, no blocks. */
static bool is_plain(const CeedElementMap *map) {
  return map->type == CEED_RESTRICTION_STANDARD && map->block_size == 1 && map->num_bands == 0;
}

/* E-vector from L-vector: component c of node n of element e is u[offsets[e * elem_size + n] + c * comp_stride]. */
static void gather(const CeedElementMap *map, CeedInt first_elem, CeedInt num_elem, const CeedScalar *u,
                   CeedScalar *ru) {
  for (CeedInt e = 0; e < num_elem; e++) {
    const CeedInt *nodes = map->offsets + (CeedSize)(first_elem + e) * map->elem_size;
    for (CeedInt c = 0; c < map->num_comp; c++) {
      const CeedScalar *component = u + (CeedSize)c * map->comp_stride;
      for (CeedInt n = 0; n < map->elem_size; n++) *ru++ = component[nodes[n]];
    }
  }
}

/* Replaces restriction.apply. */
static int apply(CeedElemRestriction rstr, CeedInt first_block, CeedInt num_block, CeedTransposeMode t_mode,
                 CeedVector u, CeedVector ru) {
  const CeedElementMap *map = NULL;
  CeedCallBackend(CeedElemRestrictionGetElementMap(rstr, &map));
  if (t_mode == CEED_TRANSPOSE || !is_plain(map)) {
    return parent.restriction.apply(rstr, first_block, num_block, t_mode, u, ru);
  }

  const CeedScalar *u_array = NULL;
  CeedScalar *ru_array = NULL;
  CeedCallBackend(CeedVectorGetArrayRead(u, CEED_MEM_HOST, &u_array));
  int code = CeedVectorGetArrayWrite(ru, CEED_MEM_HOST, &ru_array);
  if (code == CEED_ERROR_SUCCESS) {
    gather(map, first_block, num_block, u_array, ru_array);
    code = CeedVectorRestoreArray(ru, &ru_array);
  }
  CeedCallBackend(CeedVectorRestoreArrayRead(u, &u_array));
  CeedCallBackend(code);

  Counter *counter = NULL;
  CeedCallBackend(CeedGetData(CeedElemRestrictionReturnCeed(rstr), &counter));
  counter->num_gathered += (CeedSize)num_block * map->elem_size * map->num_comp;
  return CEED_ERROR_SUCCESS;
}

/* Replaces ceed_destroy: the Ceed goes, and what we keep with it. */
static int destroy(Ceed ceed) {
  Counter *counter = NULL;
  CeedCallBackend(CeedGetData(ceed, &counter));
  if (counter->is_counting) fprintf(stderr, "gathered %td values\n", counter->num_gathered);
  free(counter);
  return CEED_ERROR_SUCCESS;
}

/* 0 and a reason where the backend cannot work: a missing device, an instruction set, a license. */
static int score(const char **reason) {
  if (getenv("TEMPLATE_OFF") == NULL) return 1;
  *reason = "TEMPLATE_OFF is set in the environment";
  return 0;
}

/* Opens the backend for one Ceed. `options` is what follows the colon in "/cpu/self/template:count". */
static int init(Ceed ceed, const char *options, CeedBackendOps *ops) {
  const bool is_counting = strcmp(options, "count") == 0;
  CeedCheck(is_counting || options[0] == '\0', ceed, CEED_ERROR_MINOR,
            "Option '%s' of /cpu/self/template is unknown; expected 'count'", options);
  Counter *counter = calloc(1, sizeof *counter);
  CeedCheck(counter != NULL, ceed, CEED_ERROR_BACKEND, "Out of memory");
  counter->is_counting = is_counting;
  CeedCallBackend(CeedSetData(ceed, counter));

  if (parent.size == 0) parent = *ops; /* one thread at a time is in here */
  ops->ceed_destroy = destroy;
  ops->restriction.apply = apply;
  return CEED_ERROR_SUCCESS;
}

static const char *const aliases[] = {"/cpu/self/example", NULL};

static const CeedBackend backends[] = {{
    .resource = "/cpu/self/template",
    .parent = "/cpu/self/ref/serial",
    .priority = 1000,
    .aliases = aliases,
    .score = score,
    .init = init,
}};

static const CeedPlugin plugin = {
    .size = sizeof(CeedPlugin),
    .api_version = CEED_PLUGIN_API_VERSION,
    .name = "template",
    .num_backends = sizeof backends / sizeof backends[0],
    .backends = backends,
};

const CeedPlugin *ceed_plugin_v1(void) { return &plugin; }
