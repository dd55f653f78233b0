#include "solve/stages.hpp"

#include <array>

#include "options/error.hpp"

namespace hg {

namespace {

PetscLogStage number(Stage stage) {
  static const std::array<PetscLogStage, 5> stages = [] {
    std::array<PetscLogStage, 5> made{};
    const char *names[] = {"Setup", "Solve", "Update", "Migrate", "Output"};
    for (int i = 0; i < 5; ++i) petsc_check(PetscLogStageRegister(names[i], &made[i]));
    return made;
  }();
  return stages[static_cast<int>(stage)];
}

}  // namespace

StageScope::StageScope(Stage stage) {
  petsc_check(PetscLogStagePush(number(stage)));
}
StageScope::~StageScope() {
  (void)PetscLogStagePop();
}

}  // namespace hg
