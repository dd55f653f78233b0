#include "case.hpp"

#include <algorithm>

#include "support/errors.hpp"

namespace hg::test {

CeedInt Case::size(const Field &field) const {
  if (field.mode == CEED_EVAL_WEIGHT) return 1;
  return spaces[field.space].num_comp * spaces[field.space].q_comp(dim, field.mode);
}

CeedSize Case::input_size() const {
  for (const Field &field : inputs) {
    if (field.is_active()) return spaces[field.space].l_size;
  }
  return 0;
}

CeedSize Case::output_size() const {
  for (const Field &field : outputs) {
    if (field.is_active()) return spaces[field.space].l_size;
  }
  return 0;
}

CeedInt Case::total_points() const {
  CeedInt total = 0;
  for (const CeedInt n : num_points) total += n;
  return total;
}

CeedInt Case::max_points() const {
  return num_points.empty() ? 0 : *std::max_element(num_points.begin(), num_points.end());
}

CeedScalar Case::weight(CeedInt q) const {
  if (at_points) return 1;
  Values points(Q_1d), weights(Q_1d);
  ok(quad_mode == CEED_GAUSS ? CeedGaussQuadrature(Q_1d, points.data(), weights.data())
                             : CeedLobattoQuadrature(Q_1d, points.data(), weights.data()));
  CeedScalar product = 1;
  for (CeedInt d = 0; d < dim; d++, q /= Q_1d) product *= weights[q % Q_1d];
  return product;
}

std::string describe(const Case &c) {
  std::string text = std::to_string(c.dim) + "D, " + std::to_string(c.num_elem) + " elements, " +
                     (c.at_points ? std::to_string(c.total_points()) + " points" : "Q_1d " + std::to_string(c.Q_1d));
  for (const std::vector<Field> *fields : {&c.inputs, &c.outputs}) {
    for (const Field &field : *fields) {
      text += "; " + field.name + " " + CeedEvalModes[field.mode];
      if (field.mode == CEED_EVAL_WEIGHT) continue;
      const Space &space = c.spaces[field.space];
      text += field.is_active() ? " active" : " passive " + std::to_string(field.vector);
      text += ", space " + std::to_string(field.space) + " (";
      text += space.is_tabulated() ? std::string(CeedFESpaces[space.kind]) + ", P " + std::to_string(space.elem_size)
                                   : "P_1d " + std::to_string(space.P_1d);
      text += ", " + std::to_string(space.num_comp) + " components)";
    }
  }
  return text;
}

void lagrange(const Values &nodes, CeedScalar x, Values &value, Values &derivative) {
  const std::size_t n = nodes.size();
  value.assign(n, 1);
  derivative.assign(n, 0);
  for (std::size_t i = 0; i < n; i++) {
    for (std::size_t j = 0; j < n; j++) {
      if (j == i) continue;
      value[i] *= (x - nodes[j]) / (nodes[i] - nodes[j]);
      CeedScalar product = 1 / (nodes[i] - nodes[j]);
      for (std::size_t k = 0; k < n; k++) {
        if (k != i && k != j) product *= (x - nodes[k]) / (nodes[i] - nodes[k]);
      }
      derivative[i] += product;
    }
  }
}

std::vector<std::vector<Term>> terms(const Case &c, const Field &field, CeedInt elem, CeedInt q) {
  std::vector<std::vector<Term>> result(c.size(field));
  const Space &space = c.spaces[field.space];
  const auto place = [&](CeedInt node, CeedInt comp) {
    return static_cast<CeedSize>(space.offsets[elem * space.elem_size + node]) +
           static_cast<CeedSize>(comp) * space.comp_stride;
  };
  const auto add = [&](std::vector<Term> &value, CeedInt node, CeedInt comp, CeedScalar coefficient) {
    if (space.orientation.empty()) return value.push_back({place(node, comp), coefficient});
    for (CeedInt m = std::max(node - 1, 0); m <= std::min(node + 1, space.elem_size - 1); m++) {
      const CeedScalar turned = space.orientation[3 * (elem * space.elem_size + node) + 1 + m - node];
      value.push_back({place(m, comp), turned * coefficient});
    }
  };
  if (field.mode == CEED_EVAL_NONE) {
    for (CeedInt comp = 0; comp < space.num_comp; comp++) {
      if (c.at_points) {
        result[comp].push_back({static_cast<CeedSize>(c.point_numbers[elem][q]) * space.num_comp + comp, 1});
      } else {
        add(result[comp], q, comp, 1);
      }
    }
    return result;
  }
  if (space.is_tabulated()) {
    const Values &matrix = field.mode == CEED_EVAL_INTERP ? space.interp : space.derivative;
    const CeedInt Q = c.max_points();
    for (CeedInt g = 0; g < space.q_comp(c.dim, field.mode); g++) {
      for (CeedInt node = 0; node < space.elem_size; node++) {
        for (CeedInt comp = 0; comp < space.num_comp; comp++) {
          add(result[g * space.num_comp + comp], node, comp,
              matrix[(static_cast<std::size_t>(g) * Q + q) * space.elem_size + node]);
        }
      }
    }
    return result;
  }
  std::vector<Values> value(c.dim), derivative(c.dim);
  if (!space.interp_1d.empty()) {
    for (CeedInt d = 0, rest = q; d < c.dim; d++, rest /= c.Q_1d) {
      const auto row = static_cast<std::ptrdiff_t>(rest % c.Q_1d) * space.P_1d;
      value[d].assign(space.interp_1d.begin() + row, space.interp_1d.begin() + row + space.P_1d);
      derivative[d].assign(space.grad_1d.begin() + row, space.grad_1d.begin() + row + space.P_1d);
    }
  } else {
    Values nodes(space.P_1d);
    ok(CeedLobattoQuadrature(space.P_1d, nodes.data(), nullptr));
    for (CeedInt d = 0; d < c.dim; d++) lagrange(nodes, c.x[elem][q][d], value[d], derivative[d]);
  }
  const CeedInt num_directions = field.mode == CEED_EVAL_GRAD ? c.dim : 1;
  for (CeedInt direction = 0; direction < num_directions; direction++) {
    for (CeedInt node = 0; node < space.elem_size; node++) {
      CeedScalar product = 1;
      for (CeedInt d = 0, rest = node; d < c.dim; d++, rest /= space.P_1d) {
        const bool is_derived = field.mode == CEED_EVAL_GRAD && d == direction;
        product *= is_derived ? derivative[d][rest % space.P_1d] : value[d][rest % space.P_1d];
      }
      for (CeedInt comp = 0; comp < space.num_comp; comp++) {
        add(result[direction * space.num_comp + comp], node, comp, product);
      }
    }
  }
  return result;
}

namespace {

/// 1 + Σ_j factor_j y_j at a point.
CeedScalar scale_at(const Case &c, CeedInt elem, CeedInt q) {
  CeedScalar scale = 1;
  CeedInt j = 0;
  for (const Field &field : c.inputs) {
    if (field.is_active()) continue;
    if (field.mode == CEED_EVAL_WEIGHT) {
      scale += c.mix.factor[j++] * c.weight(q);
      continue;
    }
    for (const auto &value : terms(c, field, elem, q)) {
      CeedScalar sum = 0;
      for (const Term &term : value) sum += term.coefficient * c.passive[field.vector][term.index];
      scale += c.mix.factor[j++] * sum;
    }
  }
  return scale;
}

CeedInt num_active_inputs(const Case &c) {
  CeedInt count = 0;
  for (const Field &field : c.inputs) count += field.is_active() ? c.size(field) : 0;
  return count;
}

CeedInt num_outputs(const Case &c) {
  CeedInt count = 0;
  for (const Field &field : c.outputs) count += c.size(field);
  return count;
}

}  // namespace

Values qfunction_matrix(const Case &c, CeedInt elem, CeedInt q) {
  const CeedInt num_in = num_active_inputs(c);
  const CeedScalar scale = scale_at(c, elem, q);
  Values result;
  CeedInt row = 0;
  for (const Field &field : c.outputs) {
    for (CeedInt k = 0; k < c.size(field); k++, row++) {
      if (!field.is_active()) continue;
      for (CeedInt i = 0; i < num_in; i++) result.push_back(scale * c.mix.matrix[row * MIX_MAX_VALUES + i]);
    }
  }
  return result;
}

bool is_output(const Case &c, int i) {
  return std::any_of(c.outputs.begin(), c.outputs.end(), [&](const Field &field) { return field.vector == i; });
}

Outcome apply(const Case &c, const Values &in) {
  Outcome outcome;
  outcome.active.assign(static_cast<std::size_t>(c.output_size()), 0);
  for (const Values &values : c.passive) outcome.passive.emplace_back(values.size(), 0);
  for (CeedInt elem = 0; elem < c.num_elem; elem++) {
    for (CeedInt q = 0; q < c.num_points[elem]; q++) {
      Values active;
      for (const Field &field : c.inputs) {
        if (!field.is_active()) continue;
        for (const auto &value : terms(c, field, elem, q)) {
          active.push_back(0);
          for (const Term &term : value) active.back() += term.coefficient * in[term.index];
        }
      }
      if (active.empty()) active.push_back(1);
      const CeedScalar scale = scale_at(c, elem, q);
      CeedInt row = 0;
      for (const Field &field : c.outputs) {
        Values &target = field.is_active() ? outcome.active : outcome.passive[field.vector];
        for (const auto &value : terms(c, field, elem, q)) {
          CeedScalar sum = 0;
          for (std::size_t i = 0; i < active.size(); i++) sum += c.mix.matrix[row * MIX_MAX_VALUES + i] * active[i];
          for (const Term &term : value) target[term.index] += term.coefficient * scale * sum;
          row++;
        }
      }
    }
  }
  return outcome;
}

Values matrix(const Case &c) {
  const CeedSize num_rows = c.output_size(), num_cols = c.input_size();
  Values result(static_cast<std::size_t>(num_rows * num_cols), 0);
  for (CeedInt elem = 0; elem < c.num_elem; elem++) {
    for (CeedInt q = 0; q < c.num_points[elem]; q++) {
      const Values d = qfunction_matrix(c, elem, q);
      std::vector<std::vector<Term>> rows, cols;
      for (const Field &field : c.outputs) {
        if (!field.is_active()) continue;
        for (auto &value : terms(c, field, elem, q)) rows.push_back(std::move(value));
      }
      for (const Field &field : c.inputs) {
        if (!field.is_active()) continue;
        for (auto &value : terms(c, field, elem, q)) cols.push_back(std::move(value));
      }
      for (std::size_t o = 0; o < rows.size(); o++) {
        for (std::size_t i = 0; i < cols.size(); i++) {
          for (const Term &row : rows[o]) {
            for (const Term &col : cols[i]) {
              result[row.index * num_cols + col.index] += row.coefficient * d[o * cols.size() + i] * col.coefficient;
            }
          }
        }
      }
    }
  }
  return result;
}

CeedSize num_terms(const Case &c) {
  CeedSize nodes = 1;
  for (const Space &space : c.spaces) {
    nodes = std::max<CeedSize>(nodes, space.elem_size * (space.orientation.empty() ? 1 : 9));
  }
  return nodes * std::max<CeedSize>(1, num_active_inputs(c)) + c.total_points() * num_outputs(c) + 4 * nodes;
}

}  // namespace hg::test
