#include "qfunctions_in_c.h"

const NamedQFunction *qfunctions_in_c(void) {
  return all_qfunctions;
}
