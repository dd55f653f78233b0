// main for the mechanics tests: PETSc runs around GoogleTest, rank 0 reports, and a failure on any rank fails the run.
#include <gtest/gtest.h>
#include <petscsys.h>

#include "options/error.hpp"

int main(int argc, char **argv) {
  testing::InitGoogleTest(&argc, argv);
  if (PetscInitialize(&argc, &argv, nullptr, nullptr)) return 1;
  int failed = 0;
  {
    hg::PetscErrorScope errors;
    int rank = 0;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    auto &listeners = testing::UnitTest::GetInstance()->listeners();
    if (rank != 0) {
      // Failures still show, from the rank that has them; progress only once.
      struct FailuresOnly : testing::EmptyTestEventListener {
        void OnTestPartResult(const testing::TestPartResult &result) override {
          if (!result.failed()) return;
          int rank = 0;
          MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
          std::fprintf(stderr, "[rank %d] %s:%d: %s\n", rank, result.file_name() ? result.file_name() : "?",
                       result.line_number(), result.summary());
        }
      };
      delete listeners.Release(listeners.default_result_printer());
      listeners.Append(new FailuresOnly);
    }
    const int mine = RUN_ALL_TESTS();
    MPI_Allreduce(&mine, &failed, 1, MPI_INT, MPI_MAX, PETSC_COMM_WORLD);
  }
  PetscFinalize();
  return failed;
}
