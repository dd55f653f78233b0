/// @file
/// The stages that -log_view shows.
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

}  // namespace hg
