/// @file
/// The stages that -log_view shows, and what the operators take of them.
#pragma once

#include <petsclog.h>

namespace hg {

enum class Stage { setup, solve, update, migrate, output };

/// Everything in its lifetime counts for a stage.
class StageScope {
 public:
  explicit StageScope(Stage stage);
  ~StageScope();
  StageScope(const StageScope &) = delete;
  StageScope &operator=(const StageScope &) = delete;
};

enum class OperatorWork { residual, jacobian, matrix, diagonal };

/// Everything in its lifetime is an operator's work on this rank, without what is exchanged between ranks: the events
/// OpResidual, OpJacobian, OpMatrix and OpDiagonal.
class OperatorScope {
 public:
  explicit OperatorScope(OperatorWork work);
  ~OperatorScope();
  OperatorScope(const OperatorScope &) = delete;
  OperatorScope &operator=(const OperatorScope &) = delete;

 private:
  PetscLogEvent event_;
};

}  // namespace hg
