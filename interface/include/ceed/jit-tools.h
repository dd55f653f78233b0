/// @file
/// Files of sources that are compiled when the program runs. The contract of ceed.h holds here, too. Error
/// CEED_ERROR_MINOR: a path is NULL.
#ifndef CEED_JIT_TOOLS_H
#define CEED_JIT_TOOLS_H

#include <ceed.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Whether there is a file at `source_file_path` (`is_valid`); what follows a last colon, the name of a function, is
/// not part of it.
CEED_EXTERN int CeedCheckFilePath(Ceed ceed, const char *source_file_path, bool *is_valid);
/// The part of `absolute_file_path` from its last "ceed/jit-source" on, which points into the given text, the caller's.
/// Error CEED_ERROR_MAJOR where it has none.
CEED_EXTERN int CeedGetJitRelativePath(const char *absolute_file_path, const char **relative_file_path);
/// The file `relative_file_path` below one of the source roots: those of CeedAddJitSourceRoot() in their order, then
/// the folder of the installed headers. The caller frees the path with free(). Error CEED_ERROR_MAJOR, naming the
/// roots, where it is in none.
CEED_EXTERN int CeedGetJitAbsolutePath(Ceed ceed, const char *relative_file_path, const char **absolute_file_path);

#ifdef __cplusplus
}
#endif

#endif
