#include "cases.hpp"

#include <cstdlib>
#include <memory>
#include <new>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "memory.hpp"

namespace hg::micro {

namespace {

using host::BlockNodes;
using host::Kernels;
using host::max_width;
using host::PointEvaluation;
using host::Symmetry;

/// CEED_HOST_ISA for a scope: the tables of kernels are chosen by it.
class ChosenSet {
 public:
  ChosenSet() {
    if (const char *before = std::getenv(variable)) before_ = before;
  }
  ~ChosenSet() {
    if (before_) {
      choose(*before_);
    } else {
      unsetenv(variable);
    }
  }
  ChosenSet(const ChosenSet &) = delete;
  ChosenSet &operator=(const ChosenSet &) = delete;

  void choose(const std::string &name) { setenv(variable, name.c_str(), 1); }
  const std::optional<std::string> &before() const { return before_; }

 private:
  static constexpr const char *variable = "CEED_HOST_ISA";
  std::optional<std::string> before_;
};

/// `size` numbers in (-1, 1), the same in every run; kernels may read a pack beyond.
std::shared_ptr<CeedScalar[]> numbers(CeedSize size) {
  host::Array array = host::allocate_array(static_cast<std::size_t>(size) + max_width);
  if (!array) throw std::bad_alloc();
  unsigned state = 1;
  for (CeedSize i = 0; i < size + max_width; i++) {
    state = state * 1664525u + 1013904223u;
    array[i] = state / 2147483648.0 - 1;
  }
  return {array.release(), host::FreeArray()};
}

/// Collects the cases of one table of kernels.
class List {
 public:
  List(const InstructionSet &set, const Kernels &kernels)
      : kernels_(kernels), prefix_(set.name + (&kernels == set.blocked ? "/blocked/" : "/serial/")), W_(set.width()) {}

  void contraction(Symmetry symmetry, CeedInt M, CeedInt N, CeedInt pre, CeedInt post, bool add);
  void gather(CeedInt degree, CeedInt num_comp);
  void scatter_add(CeedInt degree, CeedInt num_comp);
  void rows(CeedInt count);
  void points(CeedInt K, bool with_derivatives, CeedInt num_points, CeedInt num_comp, bool is_across = false);
  void point_vectors(CeedInt num_points, CeedInt num_comp);

  std::vector<Case> take() { return std::move(cases_); }

 private:
  void add(const std::string &name, const Work &work, std::function<std::function<void()>()> prepare) {
    cases_.push_back({prefix_ + name, work, std::move(prepare)});
  }

  const Kernels &kernels_;
  std::string prefix_;
  double W_;  ///< numbers of a pack, also where a block is one element
  std::vector<Case> cases_;
};

template <typename... Parts>
std::string joined(const Parts &...parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

/// Floor: (N + M) pre*post loads and stores, M N pre*post multiplications with additions, half of them where B is
/// symmetric; what is added to is loaded too.
void List::contraction(Symmetry symmetry, CeedInt M, CeedInt N, CeedInt pre, CeedInt post, bool adds) {
  const host::Contraction kernel = kernels_.contraction(M, N, symmetry, adds);
  if (kernel == nullptr) return;
  const double elements = kernels_.width, places = elements * pre * post / W_;
  Work work{.fmas = M * N * places * (symmetry == Symmetry::none ? 1 : 0.5),
            .loads = (N + (adds ? M : 0)) * places,
            .stores = M * places};
  work.bytes = (work.loads + work.stores) * W_ * sizeof(CeedScalar);
  const char *kind = symmetry == Symmetry::even ? "even" : symmetry == Symmetry::odd ? "odd" : "any";
  add(joined("contraction/", kind, "/", M, "x", N, post > 1 ? "" : "/first", adds ? "/add" : "/set"), work,
      [=, width = kernels_.width, columns = kernels_.columns] {
        const CeedSize stride = columns > 0 ? (M + columns - 1) / columns * columns : 0;
        return [=, B = numbers(M * N + stride * N), in = numbers(static_cast<CeedSize>(N) * pre * post * width),
                out = numbers(static_cast<CeedSize>(M) * pre * post * width),
                ahead = host::Ahead()]() mutable { kernel(B.get(), M, N, pre, post, in.get(), out.get(), ahead); };
      });
}

/// Elements of one row of a box of `degree`: nodes between neighbours are shared.
struct RowOfElements {
  RowOfElements(CeedInt degree, CeedInt num_comp, CeedInt num_elem) {
    const CeedInt P = degree + 1, along = degree * num_elem + 1;
    nodes = {P * P * P, num_comp, 1, 1, {}};
    l_size = static_cast<CeedSize>(along) * P * P * num_comp;
    for (CeedInt e = 0; e < num_elem; e++) {
      for (CeedInt n = 0; n < nodes.num_nodes; n++) {
        offsets->push_back((e * degree + n % P + along * (n / P)) * num_comp);
      }
    }
    for (CeedInt e = 0; e < num_elem; e++) nodes.offsets[e] = offsets->data() + e * nodes.num_nodes;
  }

  std::shared_ptr<std::vector<CeedInt>> offsets = std::make_shared<std::vector<CeedInt>>();
  BlockNodes nodes;
  CeedSize l_size;
};

/// Floor: each number of the L-vector is loaded by itself.
void List::gather(CeedInt degree, CeedInt num_comp) {
  const CeedInt width = kernels_.width, num_nodes = CeedIntPow(degree + 1, 3);
  const double count = static_cast<double>(width) * num_nodes * num_comp;
  const Work work{.stores = count / W_,
                  .number_loads = count,
                  .bytes = 2 * sizeof(CeedScalar) * count + sizeof(CeedInt) * count / num_comp};
  add(joined("gather/", num_nodes, "x", num_comp), work, [=, kernel = kernels_.gather] {
    const RowOfElements row(degree, num_comp, width);
    return [=, l = numbers(row.l_size), block = numbers(static_cast<CeedSize>(width) * num_nodes * num_comp)] {
      kernel(row.nodes, l.get(), block.get());
    };
  });
}

/// Floor: each number of the L-vector is loaded and stored by itself. All elements of a block.
void List::scatter_add(CeedInt degree, CeedInt num_comp) {
  const CeedInt width = kernels_.width, num_nodes = CeedIntPow(degree + 1, 3);
  const double count = static_cast<double>(width) * num_nodes * num_comp;
  const Work work{.loads = count / W_,
                  .number_loads = count,
                  .number_stores = count,
                  .bytes = 3 * sizeof(CeedScalar) * count + sizeof(CeedInt) * count / num_comp};
  add(joined("scatter_add/", num_nodes, "x", num_comp), work, [=, kernel = kernels_.scatter_add] {
    const RowOfElements row(degree, num_comp, width);
    const CeedSize row_size = static_cast<CeedSize>(num_nodes) * num_comp;
    return [=, l = numbers(row.l_size), rows = numbers(row_size * width)] {
      for (CeedInt lane = 0; lane < width; lane++) kernel(row.nodes, lane, rows.get() + lane * row_size, l.get());
    };
  });
}

/// Floor: rows are turned in registers.
void List::rows(CeedInt count) {
  const CeedInt width = kernels_.width;
  const CeedSize size = static_cast<CeedSize>(count) * width;
  const Work work{
      .loads = size / W_, .stores = size / W_, .bytes = 2.0 * static_cast<double>(sizeof(CeedScalar)) * size};
  add(joined("gather_rows/", count), work, [=, kernel = kernels_.gather_rows] {
    return [=, from = numbers(size), block = numbers(size)] {
      const CeedScalar *rows[max_width];
      for (CeedInt lane = 0; lane < width; lane++) rows[lane] = from.get() + static_cast<CeedSize>(lane) * count;
      kernel(count, rows, block.get());
    };
  });
  add(joined("to_rows/", count), work, [=, kernel = kernels_.to_rows] {
    return [=, block = numbers(size), to = numbers(size)] { kernel(count, block.get(), to.get()); };
  });
}

/// Floor of a pack of points: 2 K^3 + 3 K^2 + 4 K multiplications with additions with derivatives, K^3 + K^2 + K
/// without, for each component. Across: as many points in each element of a block.
void List::points(CeedInt K, bool with_derivatives, CeedInt points_each, CeedInt num_comp, bool is_across) {
  const CeedInt width = kernels_.width, num_elem = is_across ? width : 1;
  const CeedInt num_points = points_each * num_elem, num_coefficients = K * K * K * num_comp;
  const CeedSize stride = (num_points + max_width - 1) / max_width * max_width;
  const double packs = num_points / W_, fields = num_comp * (with_derivatives ? 3.0 : 1.0);
  const double fmas = with_derivatives ? (2.0 * K + 3) * K * K + 4 * K : (K + 1.0) * K * K + K;
  const double bytes = sizeof(CeedScalar) * (num_points * (3 + fields) + num_coefficients * num_elem);
  const std::string name = joined(K, with_derivatives ? "/derivatives/" : "/values/", points_each, "x", num_comp,
                                  is_across ? "/across" : "");
  const auto prepare = [=](auto call) {
    return [=, x = numbers(3 * stride), at_points = numbers(stride * static_cast<CeedSize>(fields)),
            coefficients = numbers(static_cast<CeedSize>(num_coefficients) * width), ahead = host::Ahead()]() mutable {
      const PointEvaluation evaluation{3, K, num_comp, num_points, x.get(), stride, &ahead};
      CeedScalar *fields = at_points.get();
      call(evaluation, coefficients.get(), with_derivatives ? nullptr : fields, with_derivatives ? fields : nullptr);
    };
  };
  Work work{.fmas = packs * num_comp * fmas, .loads = 3 * packs, .stores = fields * packs, .bytes = bytes};
  add(joined("points/evaluate/", name), work,
      [=, kernel = kernels_.point_evaluation(K, with_derivatives, is_across)] { return prepare(kernel); });
  std::swap(work.loads, work.stores);
  work.loads += work.stores;
  work.stores = 0;
  add(joined("points/integrate/", name), work,
      [=, kernel = kernels_.point_integration(K, with_derivatives, is_across)] {
        return prepare(
            [=, sums = numbers(static_cast<CeedSize>(num_coefficients) * max_width)](
                const PointEvaluation &evaluation, CeedScalar *coefficients, const CeedScalar *values,
                const CeedScalar *derivatives) { kernel(evaluation, values, derivatives, sums.get(), coefficients); });
      });
}

/// Floor: a point's numbers are loaded four at a time, and on the way back loaded and stored one by one.
void List::point_vectors(CeedInt num_points, CeedInt num_comp) {
  const double count = static_cast<double>(num_points) * num_comp;
  const CeedSize stride = (num_points + max_width - 1) / max_width * max_width;
  const CeedSize l_size = static_cast<CeedSize>(2) * num_points * num_comp;
  const std::string name = joined(num_points, "x", num_comp);
  const double bytes = sizeof(CeedInt) * static_cast<double>(num_points) + 2 * sizeof(CeedScalar) * count;
  // Every other point of the vector, backwards.
  const auto make_offsets = [=] {
    auto offsets = std::make_shared<std::vector<CeedInt>>();
    for (CeedInt p = num_points; p-- > 0;) offsets->push_back(2 * p);
    return offsets;
  };
  const double fours = (num_comp + 3.0 - (num_comp + 3) % 4) / 4 * num_points;
  add(joined("gather_points/", name), {.stores = count / W_, .number_loads = fours, .bytes = bytes},
      [=, kernel = kernels_.gather_points] {
        return [=, offsets = make_offsets(), l = numbers(l_size), values = numbers(stride * num_comp)] {
          kernel(num_points, num_comp, offsets->data(), l.get(), l_size, stride, values.get());
        };
      });
  add(joined("scatter_add_points/", name),
      {.loads = count / W_, .number_loads = count, .number_stores = count, .bytes = bytes + sizeof(CeedScalar) * count},
      [=, kernel = kernels_.scatter_points[1]] {
        return [=, offsets = make_offsets(), l = numbers(l_size), values = numbers(stride * num_comp)] {
          kernel(num_points, num_comp, offsets->data(), values.get(), stride, l.get());
        };
      });
}

}  // namespace

std::vector<InstructionSet> instruction_sets() {
  ChosenSet chosen;
  std::vector<InstructionSet> sets;
  for (const char *name : {"avx512", "avx2", "portable"}) {
    if (chosen.before() && *chosen.before() != name) continue;
    chosen.choose(name);
    const char *reason = nullptr;
    const Kernels *blocked = host::kernels(true, &reason), *serial = host::kernels(false, &reason);
    if (blocked != nullptr && serial != nullptr) sets.push_back({name, blocked, serial});
  }
  if (sets.empty()) {
    throw std::runtime_error("CEED_HOST_ISA is '" + chosen.before().value_or("") +
                             "', which is no instruction set of this machine; expected portable, avx2 or avx512");
  }
  return sets;
}

std::vector<Case> cases(const InstructionSet &set) {
  std::vector<Case> all;
  for (const Kernels *kernels : {set.blocked, set.serial}) {
    List list(set, *kernels);
    // Of an element with P nodes a direction and one component: the second direction from nodes to Q points (pre = P,
    // post = Q), and from points to nodes; Q by Q: the derivative between points.
    for (const CeedInt P : {2, 4, 8}) {
      const CeedInt Q = P + 1;
      for (const Symmetry symmetry : {Symmetry::even, Symmetry::none}) {
        list.contraction(symmetry, Q, P, P, Q, false);
        list.contraction(symmetry, P, Q, Q, P, true);
      }
      for (const Symmetry symmetry : {Symmetry::odd, Symmetry::none}) {
        list.contraction(symmetry, Q, Q, Q, Q, false);
        list.contraction(symmetry, Q, Q, Q, Q, true);
      }
    }
    // The first direction; and bases that are no tensor products: tetrahedra of degree 2, three components.
    list.contraction(Symmetry::none, 5, 4, 16, 1, false);
    list.contraction(Symmetry::none, 14, 10, 3, 1, false);
    for (const CeedInt degree : {1, 3}) {
      for (const CeedInt num_comp : {1, 3}) list.gather(degree, num_comp);
    }
    for (const CeedInt count : {8, 125, 750}) list.rows(count);
    for (const CeedInt K : {2, 3, 5}) {
      for (const bool with_derivatives : {false, true}) {
        for (const CeedInt num_points : {8, 27, 64}) list.points(K, with_derivatives, num_points, 1);
        if (kernels == set.blocked) list.points(K, with_derivatives, 8, 1, true);
      }
    }
    list.points(3, true, 27, 3);
    // These kernels are the same ones in both tables.
    if (kernels == set.blocked) {
      for (const CeedInt degree : {1, 3}) {
        for (const CeedInt num_comp : {1, 3}) list.scatter_add(degree, num_comp);
      }
      for (const CeedInt num_comp : {1, 3, 6}) list.point_vectors(27, num_comp);
    }
    for (Case &one : list.take()) all.push_back(std::move(one));
  }
  return all;
}

}  // namespace hg::micro
