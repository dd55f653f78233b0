/// @file
/// What a block does between two barriers, and the arrays that it leaves in shared memory from one phase to another.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace hg::gpu {

/// Steps of phases, which are printed in their order, with barriers between phases. Arrays whose phases do not overlap
/// share memory.
class Phases {
 public:
  /// An array of so many numbers for each element of a block. Those with equal `shape` lie alike.
  int array(std::string name, std::size_t size, std::string shape) {
    arrays_.push_back({.name = std::move(name), .shape = std::move(shape), .size = size});
    return static_cast<int>(arrays_.size()) - 1;
  }
  /// The name of an array that is read or written in a phase.
  std::string use(int array, int phase) {
    Array &a = arrays_[array];
    a.first = std::min(a.first, phase);
    a.last = std::max(a.last, phase);
    return "shared + " + a.name;
  }
  void step(int phase, const std::string &line) {
    if (static_cast<int>(steps_.size()) <= phase) steps_.resize(phase + 1);
    steps_[phase] += "  " + line + '\n';
  }
  /// In this phase each thread reads what it wants before it writes, at the same places: `written` may take the memory
  /// of an array that lies alike and is not used later.
  void replaces(int written, int phase) {
    for (Array &a : arrays_) {
      if (a.last != phase || a.first >= phase || a.is_replaced || a.shape != arrays_[written].shape) continue;
      a.is_replaced = true;
      arrays_[written].replaced = static_cast<int>(&a - arrays_.data());
      return;
    }
  }
  int num_phases() const { return static_cast<int>(steps_.size()); }

  /// Lays the arrays out, each at the first place that is free as long as it is used. Numbers for each element.
  std::size_t place() {
    std::vector<int> order;
    std::size_t end = 0;
    // Those that are replaced live as long as what replaces them.
    for (Array &a : arrays_) {
      if (a.replaced < 0) continue;
      arrays_[a.replaced].last = std::max(arrays_[a.replaced].last, a.last);
    }
    for (std::size_t i = 0; i < arrays_.size(); i++) {
      if (arrays_[i].replaced < 0 && arrays_[i].last >= 0) order.push_back(static_cast<int>(i));
    }
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return arrays_[a].size > arrays_[b].size; });
    for (std::size_t i = 0; i < order.size(); i++) {
      Array &a = arrays_[order[i]];
      a.place = 0;
      for (bool moved = true; moved;) {
        moved = false;
        for (std::size_t j = 0; j < i; j++) {
          const Array &b = arrays_[order[j]];
          const bool at_once = a.first <= b.last && b.first <= a.last;
          const bool overlaps = a.place < b.place + b.size && b.place < a.place + a.size;
          if (!at_once || !overlaps) continue;
          a.place = b.place + b.size;
          moved = true;
        }
      }
      end = std::max(end, a.place + a.size);
    }
    for (Array &a : arrays_) {
      if (a.replaced >= 0) a.place = arrays_[a.replaced].place;
    }
    return end;
  }
  /// The places of the arrays, in a block of `elems` elements.
  std::string declarations() const {
    std::string text;
    for (const Array &a : arrays_) {
      if (a.last >= 0) text += "  constexpr int " + a.name + " = elems * " + std::to_string(a.place) + ";\n";
    }
    return text;
  }
  std::string text() const {
    std::string text;
    for (const std::string &steps : steps_) {
      if (!text.empty() && !steps.empty()) text += "  barrier();\n";
      text += steps;
    }
    return text;
  }

 private:
  struct Array {
    std::string name, shape;
    std::size_t size, place = 0;
    int first = std::numeric_limits<int>::max(), last = -1;  ///< phases
    int replaced = -1;                                       ///< the array whose memory this one takes
    bool is_replaced = false;
  };
  std::vector<Array> arrays_;
  std::vector<std::string> steps_;
};

}  // namespace hg::gpu
