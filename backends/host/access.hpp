/// @file
/// What backends that work on the host share beside kernels: errors on their way out of C++, and arrays for a scope.
#pragma once

#include <ceed/plugin.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace hg::host {

/// What the operator's C calls return on the way out of C++ code; the error has been reported.
struct Failed {
  int code;
};

inline void chk(int code) {
  if (code != CEED_ERROR_SUCCESS) throw Failed{code};
}

/// Runs `f` for a C function; what it throws becomes a code.
template <typename F>
int wall(Ceed ceed, F &&f) {
  try {
    f();
    return CEED_ERROR_SUCCESS;
  } catch (const Failed &failed) {
    return failed.code > 0 ? CEED_ERROR_BACKEND : failed.code;
  } catch (const std::bad_alloc &) {
    return CeedError(ceed, CEED_ERROR_BACKEND, "Out of memory");
  } catch (const std::exception &error) {
    return CeedError(ceed, CEED_ERROR_BACKEND, "%s", error.what());
  }
}

/// An array for a scope. release() ends it before, where an error still counts.
class Reader {
 public:
  explicit Reader(CeedVector vec, CeedMemType mem_type = CEED_MEM_HOST) : vec_(vec) {
    chk(CeedVectorGetArrayRead(vec, mem_type, &array_));
  }
  Reader(const Reader &) = delete;
  Reader &operator=(const Reader &) = delete;
  ~Reader() {
    if (vec_ != nullptr) CeedVectorRestoreArrayRead(vec_, &array_);
  }
  void release() { chk(CeedVectorRestoreArrayRead(std::exchange(vec_, nullptr), &array_)); }
  const CeedScalar *data() const { return array_; }

 private:
  CeedVector vec_;
  const CeedScalar *array_ = nullptr;
};

/// The same to write to.
class Writer {
 public:
  enum Mode { read_write, write_only };
  explicit Writer(CeedVector vec, Mode mode = read_write, CeedMemType mem_type = CEED_MEM_HOST) : vec_(vec) {
    chk(mode == read_write ? CeedVectorGetArray(vec, mem_type, &array_)
                           : CeedVectorGetArrayWrite(vec, mem_type, &array_));
  }
  Writer(const Writer &) = delete;
  Writer &operator=(const Writer &) = delete;
  ~Writer() {
    if (vec_ != nullptr) CeedVectorRestoreArray(vec_, &array_);
  }
  void release() { chk(CeedVectorRestoreArray(std::exchange(vec_, nullptr), &array_)); }
  CeedScalar *data() const { return array_; }

 private:
  CeedVector vec_;
  CeedScalar *array_ = nullptr;
};

/// The context's data for a scope.
class ContextData {
 public:
  explicit ContextData(CeedQFunction qf) : qf_(qf) { chk(CeedQFunctionGetContextData(qf, CEED_MEM_HOST, &data_)); }
  ContextData(const ContextData &) = delete;
  ContextData &operator=(const ContextData &) = delete;
  ~ContextData() {
    if (qf_ != nullptr) CeedQFunctionRestoreContextData(qf_, &data_);
  }
  void release() { chk(CeedQFunctionRestoreContextData(std::exchange(qf_, nullptr), &data_)); }
  void *data() const { return data_; }

 private:
  CeedQFunction qf_;
  void *data_ = nullptr;
};

/// The arrays that an operator works on, for a scope; on a device for CEED_MEM_DEVICE.
class ProgramArrays {
 public:
  /// Those that are read for an assembly: passive sources, and the points.
  explicit ProgramArrays(const CeedProgram &program, CeedMemType mem_type = CEED_MEM_HOST) : mem_type_(mem_type) {
    read(program, nullptr);
  }
  /// As CeedOperatorOps::apply_add() gets its vectors. Passive outputs that are written, not added to, begin with
  /// zeros, unless `sets` says that the caller sets all their entries where it can, see is_set().
  ProgramArrays(const CeedProgram &program, CeedVector in, CeedVector out, CeedApplyMode mode, bool sets = false,
                CeedMemType mem_type = CEED_MEM_HOST)
      : mem_type_(mem_type), is_set_(program.num_sinks, false) {
    for (CeedInt t = 0; mode == CEED_APPLY_ADD_ACTIVE && t < program.num_sinks; t++) {
      if (program.sinks[t].is_active) continue;
      is_set_[t] = sets && can_be_set(program, t);
      if (!is_set_[t]) chk(CeedVectorSetValue(program.sinks[t].vec, 0.0));
    }
    read(program, in);
    // Several sinks may share a vector, which has one writer at a time.
    std::vector<CeedVector> written;
    for (CeedInt t = 0; t < program.num_sinks; t++) {
      const CeedVector vec = program.sinks[t].is_active ? out : program.sinks[t].vec;
      const auto found = std::find(written.begin(), written.end(), vec);
      const auto place = static_cast<std::size_t>(found - written.begin());
      if (found == written.end()) {
        written.push_back(vec);
        writers_.push_back(
            std::make_unique<Writer>(vec, is_set_[t] ? Writer::write_only : Writer::read_write, mem_type_));
      }
      sinks_.push_back(writers_[place]->data());
    }
  }
  /// L-vectors of the program's sources (NULL: it is not read), of its sinks, and of the points' coordinates (NULL at
  /// quadrature points).
  const std::vector<const CeedScalar *> &sources() const { return sources_; }
  const std::vector<CeedScalar *> &sinks() const { return sinks_; }
  const CeedScalar *points() const { return points_ ? points_->data() : nullptr; }
  /// Whether the entries of a sink have no values yet and are to be set, not added to.
  bool is_set(std::size_t sink) const { return is_set_[sink]; }
  void release() {
    for (const auto &writer : writers_) writer->release();
    for (const auto &reader : readers_) reader->release();
    if (points_) points_->release();
  }

 private:
  /// Each entry of the vector is an entry of this sink alone.
  static bool can_be_set(const CeedProgram &program, CeedInt sink) {
    const CeedProgramSide &side = program.sinks[sink];
    const CeedElementMap *map = nullptr;
    CeedSize length = 0;
    if (!side.is_points) return false;
    for (CeedInt t = 0; t < program.num_sinks; t++) {
      if (t != sink && !program.sinks[t].is_active && program.sinks[t].vec == side.vec) return false;
    }
    chk(CeedElemRestrictionGetElementMap(side.rstr, &map));
    chk(CeedVectorGetLength(side.vec, &length));
    return map->is_copy && map->l_size == length;
  }

  void read(const CeedProgram &program, CeedVector in) {
    if (program.at_points) points_ = std::make_unique<Reader>(program.points, mem_type_);
    for (CeedInt s = 0; s < program.num_sources; s++) {
      const CeedVector vec = program.sources[s].is_active ? in : program.sources[s].vec;
      if (vec != nullptr) readers_.push_back(std::make_unique<Reader>(vec, mem_type_));
      sources_.push_back(vec != nullptr ? readers_.back()->data() : nullptr);
    }
  }

  CeedMemType mem_type_ = CEED_MEM_HOST;
  std::unique_ptr<Reader> points_;
  std::vector<std::unique_ptr<Reader>> readers_;
  std::vector<std::unique_ptr<Writer>> writers_;
  std::vector<const CeedScalar *> sources_;
  std::vector<CeedScalar *> sinks_;
  std::vector<bool> is_set_;
};

/// Calls visit(field, component, active value) for all active values of fields.
template <typename Visit>
void for_each_active(const CeedProgramField *fields, CeedInt count, Visit &&visit) {
  for (CeedInt i = 0; i < count; i++) {
    for (CeedInt c = 0; fields[i].first_value >= 0 && c < fields[i].size; c++) visit(i, c, fields[i].first_value + c);
  }
}

/// Whether a QFunction may write its context, so that it may count the points that it is called for: it is to see each
/// once.
inline bool may_count_points(CeedQFunction qf) {
  CeedQFunctionContext context = nullptr;
  bool is_writable = false;
  chk(CeedQFunctionIsContextWritable(qf, &is_writable));
  chk(CeedQFunctionGetContext(qf, &context));
  const bool has_context = context != nullptr;
  chk(CeedQFunctionContextDestroy(&context));
  return has_context && is_writable;
}

/// Throws where a QFunction that was called by itself returned another code than 0.
inline void check_returned(CeedQFunction qf, int code) {
  if (code == 0) return;
  const char *name = nullptr;
  chk(CeedQFunctionGetKernelName(qf, &name));
  throw Failed{
      CeedError(CeedQFunctionReturnCeed(qf), CEED_ERROR_BACKEND, "QFunction '%s' returned %d; expected 0", name, code)};
}

/// Throws where the QFunction of a program returned another code than 0 for the elements from `first` on.
inline void check_returned(const CeedProgram &program, int code, CeedInt first, CeedInt num_elem) {
  if (code == 0) return;
  const char *name = nullptr;
  chk(CeedQFunctionGetKernelName(program.qf, &name));
  throw Failed{CeedError(CeedQFunctionReturnCeed(program.qf), CEED_ERROR_BACKEND,
                         "QFunction '%s' returned %d in the elements %" CeedInt_FMT " to %" CeedInt_FMT "; expected 0",
                         name, code, first, first + num_elem - 1)};
}

}  // namespace hg::host
