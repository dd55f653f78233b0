/// @file
/// The gallery: the QFunctions that a program may ask for by name (CeedQFunctionCreateInteriorByName).
///
/// The library registers every entry of hg_gallery. A caller of an entry with no fields (the identities and the scales)
/// adds the fields itself: their sizes are its own choice.
#pragma once

#include <ceed/types.h>

#ifdef __cplusplus
extern "C" {
#endif

/// One input or output of a gallery QFunction.
typedef struct {
  const char *name;  ///< field name, as CeedOperatorSetField() is given it
  CeedInt size;      ///< scalars at each point
  CeedEvalMode eval_mode;
} HgGalleryField;

/// One gallery QFunction.
typedef struct {
  const char *name;  ///< gallery name; NULL ends the table
  int (*function)(void *ctx, const CeedInt Q, const CeedScalar *const *in, CeedScalar *const *out);
  const char *source;  ///< `path:function`, the path relative to the folder qfunctions
  CeedInt dim;         ///< dimension of the reference cell it is written for; 0: any
  CeedInt num_inputs, num_outputs;
  HgGalleryField inputs[2], outputs[1];
  bool takes_num_comp;  ///< its context is one CeedInt, the number of components
} HgGalleryEntry;

/// All entries; the one after the last has a NULL name.
extern const HgGalleryEntry hg_gallery[];

#ifdef __cplusplus
}
#endif
