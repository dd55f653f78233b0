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

PetscLogEvent number(OperatorWork work) {
  static const std::array<PetscLogEvent, 4> events = [] {
    std::array<PetscLogEvent, 4> made{};
    const char *names[] = {"OpResidual", "OpJacobian", "OpMatrix", "OpDiagonal"};
    PetscClassId id = 0;
    petsc_check(PetscClassIdRegister("Operators", &id));
    for (int i = 0; i < 4; ++i) petsc_check(PetscLogEventRegister(names[i], id, &made[i]));
    return made;
  }();
  return events[static_cast<int>(work)];
}

}  // namespace

StageScope::StageScope(Stage stage) {
  petsc_check(PetscLogStagePush(number(stage)));
}
StageScope::~StageScope() {
  (void)PetscLogStagePop();
}

OperatorScope::OperatorScope(OperatorWork work) : event_(number(work)) {
  petsc_check(PetscLogEventBegin(event_, nullptr, nullptr, nullptr, nullptr));
}
OperatorScope::~OperatorScope() {
  (void)PetscLogEventEnd(event_, nullptr, nullptr, nullptr, nullptr);
}

}  // namespace hg
