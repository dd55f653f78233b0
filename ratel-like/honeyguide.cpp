/// @file
/// honeyguide: quasistatic solids by finite elements or by the implicit material point method, from PETSc options.
///
/// Sample runs:
///   honeyguide -options_file ratel-like/examples/sinker-fem.yml
///   honeyguide -options_file ratel-like/examples/sinker-mpm.yml -ts_max_steps 2
#include <ceed/backend.h>
#include <petscsys.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

#include "options/error.hpp"
#include "options/options.hpp"
#include "solve/fem_run.hpp"
#include "solve/mpm_run.hpp"
#include "solve/stages.hpp"

namespace {

constexpr char help_text[] =
    "honeyguide: quasistatic solids by finite elements (-method fem) or the implicit material point method\n"
    "(-method mpm). Every option may stand on the command line or in a file: -options_file run.yml\n\n";

// PETSc would print a stack of calls; this is a question of a file name.
void require_options_files(int argc, char **argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) != "-options_file") continue;
    if (i + 1 == argc) hg::fail("option -options_file: no file name, expected a YAML or PETSc options file");
    std::FILE *file = std::fopen(argv[i + 1], "r");
    if (!file) hg::fail("option -options_file: cannot read '%s': %s", argv[i + 1], std::strerror(errno));
    std::fclose(file);
  }
}

// An option that nobody asked for is most often misspelt.
void warn_of_unused_options() {
  PetscInt count;
  char **names, **values;
  hg::petsc_check(PetscOptionsLeftGet(nullptr, &count, &names, &values));
  for (PetscInt i = 0; i < count; ++i) {
    hg::petsc_check(PetscFPrintf(PETSC_COMM_WORLD, PETSC_STDERR,
                                 "honeyguide: warning: option -%s %s was not used: misspelt, or not for this run\n",
                                 names[i], values[i] ? values[i] : ""));
  }
  hg::petsc_check(PetscOptionsLeftRestore(nullptr, &count, &names, &values));
}

void say_error_norm(MPI_Comm comm, const char *where, double error) {
  hg::petsc_check(PetscPrintf(comm, "L2 error against the manufactured solution%s: %.6e\n", where, error));
}

// What has gone between host and device, of all ranks; nothing where the backend works on the host.
void say_transfers(MPI_Comm comm, Ceed ceed) {
  CeedMemType works_in;
  CeedTransfers mine{};
  hg::ceed_check(CeedGetPreferredMemType(ceed, &works_in));
  if (works_in == CEED_MEM_HOST) return;
  hg::ceed_check(CeedGetTransfers(ceed, &mine));
  double counts[] = {static_cast<double>(mine.num_to_device), static_cast<double>(mine.bytes_to_device),
                     static_cast<double>(mine.num_to_host), static_cast<double>(mine.bytes_to_host)};
  MPI_Allreduce(MPI_IN_PLACE, counts, 4, MPI_DOUBLE, MPI_SUM, comm);
  hg::petsc_check(PetscPrintf(comm, "Copies: %.0f to the device (%.1f MB), %.0f to the host (%.1f MB)\n", counts[0],
                              counts[1] / 1e6, counts[2], counts[3] / 1e6));
}

void run(MPI_Comm comm) {
  using namespace hg;
  auto stage = std::make_unique<StageScope>(Stage::setup);
  Setup setup(comm);
  const bool help = OptionGroup(comm, "", "").helping();
  const bool mms = setup.options.forcing.kind == BodyForce::Kind::mms;
  if (setup.options.method == Method::fem) {
    FemRun fem(setup);
    stage.reset();
    if (help) return;
    fem.run();
    if (mms) say_error_norm(comm, "", fem.mms_error());
  } else {
    MpmRun mpm(setup);
    stage.reset();
    if (help) return;
    mpm.run();
    if (mms) {
      say_error_norm(comm, "", mpm.mms_error());
      say_error_norm(comm, ", at the points", mpm.mms_error_at_points());
    }
  }
  say_transfers(comm, setup.ceed);
  warn_of_unused_options();
}

}  // namespace

int main(int argc, char **argv) {
  try {
    // Before PETSc starts, so that a mistake in an options file ends in one line too.
    hg::PetscErrorScope errors;
    require_options_files(argc, argv);
    hg::petsc_check(PetscInitialize(&argc, &argv, nullptr, help_text));
    run(PETSC_COMM_WORLD);
  } catch (const std::exception &error) {
    hg::abort_run(error.what());
  }
  return PetscFinalize() ? 1 : 0;
}
