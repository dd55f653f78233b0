#include "tabulated.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "support/errors.hpp"

namespace hg::test {

CeedScalar Polynomial3::at(const CeedScalar *x) const {
  CeedScalar sum = 0;
  for (const Term &term : terms_) {
    CeedScalar product = term.coefficient;
    for (int d = 0; d < 3; d++) {
      for (int k = 0; k < term.powers[d]; k++) product *= x[d];
    }
    sum += product;
  }
  return sum;
}

Polynomial3 Polynomial3::derivative(int direction) const {
  Polynomial3 result;
  for (Term term : terms_) {
    if (term.powers[direction] == 0) continue;
    term.coefficient *= term.powers[direction]--;
    result.terms_.push_back(term);
  }
  return result;
}

void Polynomial3::add(CeedScalar factor, const Polynomial3 &other) {
  for (Term term : other.terms_) {
    term.coefficient *= factor;
    terms_.push_back(term);
  }
}

namespace {

using Point = std::array<CeedScalar, 3>;

Polynomial3 monomial(int a, int b = 0, int c = 0) {
  return Polynomial3(1, {a, b, c});
}

/// The reference shape: corners, edges, and faces (edges in two dimensions) whose corners go round so that the normal
/// points outwards.
struct Shape {
  CeedElemTopology topology;
  CeedInt dim;
  std::vector<Point> corners;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> faces;
};

const Shape line{CEED_TOPOLOGY_LINE, 1, {{-1}, {1}}, {{0, 1}}, {}};
const Shape triangle{
    CEED_TOPOLOGY_TRIANGLE, 2, {{0, 0}, {1, 0}, {0, 1}}, {{0, 1}, {1, 2}, {2, 0}}, {{0, 1}, {1, 2}, {2, 0}}};
const Shape quad{CEED_TOPOLOGY_QUAD,
                 2,
                 {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}},
                 {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
                 {{0, 1}, {1, 2}, {2, 3}, {3, 0}}};
const Shape tet{CEED_TOPOLOGY_TET,
                3,
                {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}},
                {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
const Shape prism{
    CEED_TOPOLOGY_PRISM, 3, {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, {}, {}};
const Shape hex{CEED_TOPOLOGY_HEX,
                3,
                {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}},
                {{0, 1}, {1, 2}, {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}},
                {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

Point difference(const Point &a, const Point &b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

CeedScalar along(const PolynomialField &field, const Point &x, const Point &direction) {
  CeedScalar sum = 0;
  for (std::size_t d = 0; d < field.size(); d++) sum += field[d].at(x.data()) * direction[d];
  return sum;
}

/// Value at a point.
CeedScalar value(const PolynomialField &field, const Point &x) {
  return field[0].at(x.data());
}

/// Circulation along an edge, by the midpoint rule.
CeedScalar circulation(const PolynomialField &field, const Shape &shape, const std::array<int, 2> &edge) {
  const Point &a = shape.corners[edge[0]], &b = shape.corners[edge[1]];
  const Point middle = {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  return along(field, middle, difference(b, a));
}

/// Flux out of a face (a triangle or parallelogram, in two dimensions an edge), by the rule of its centre.
CeedScalar flux(const PolynomialField &field, const Shape &shape, const std::vector<int> &face) {
  Point centre{};
  for (const int corner : face) {
    for (int d = 0; d < 3; d++) centre[d] += shape.corners[corner][d] / static_cast<CeedScalar>(face.size());
  }
  const Point a = difference(shape.corners[face[1]], shape.corners[face[0]]);
  if (shape.dim == 2) return along(field, centre, {a[1], -a[0], 0});
  const Point b = difference(shape.corners[face.back()], shape.corners[face[0]]);
  const CeedScalar part = face.size() == 3 ? 0.5 : 1;
  return part * along(field, centre, {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]});
}

/// A X = B by elimination with row exchanges: X overwrites B (n by n each).
void solve(Values a, Values &b, std::size_t n) {
  for (std::size_t k = 0; k < n; k++) {
    std::size_t pivot = k;
    for (std::size_t i = k; i < n; i++) {
      if (std::abs(a[i * n + k]) > std::abs(a[pivot * n + k])) pivot = i;
    }
    if (std::abs(a[pivot * n + k]) < 1e-12) throw std::logic_error("the functionals do not determine the field");
    for (std::size_t j = 0; j < n; j++) {
      std::swap(a[k * n + j], a[pivot * n + j]);
      std::swap(b[k * n + j], b[pivot * n + j]);
    }
    for (std::size_t i = 0; i < n; i++) {
      if (i == k) continue;
      const CeedScalar factor = a[i * n + k] / a[k * n + k];
      for (std::size_t j = 0; j < n; j++) {
        a[i * n + j] -= factor * a[k * n + j];
        b[i * n + j] -= factor * b[k * n + j];
      }
    }
  }
  for (std::size_t i = 0; i < n; i++) {
    for (std::size_t j = 0; j < n; j++) b[i * n + j] /= a[i * n + i];
  }
}

/// Gauss points on the box; on simplices they are drawn together towards corners.
void make_rule(const Shape &shape, CeedInt points, Tabulated &element) {
  Values x_1d(static_cast<std::size_t>(points)), w_1d(x_1d.size());
  ok(CeedGaussQuadrature(points, x_1d.data(), w_1d.data()));
  element.Q = CeedIntPow(points, shape.dim);
  element.q_ref.assign(static_cast<std::size_t>(element.Q) * shape.dim, 0);
  for (CeedInt q = 0; q < element.Q; q++) {
    Point x{};
    CeedScalar weight = 1;
    for (CeedInt d = 0, rest = q; d < shape.dim; d++, rest /= points) {
      x[d] = x_1d[rest % points];
      weight *= w_1d[rest % points];
    }
    const int simplex_dim = shape.topology == CEED_TOPOLOGY_TRIANGLE || shape.topology == CEED_TOPOLOGY_PRISM ? 2
                            : shape.topology == CEED_TOPOLOGY_TET                                             ? 3
                                                                                                              : 0;
    CeedScalar rest = 1;  // what the coordinates before leave of the unit simplex
    for (int d = 0; d < simplex_dim; d++) {
      weight *= rest / 2;
      x[d] = rest * (1 + x[d]) / 2;
      rest -= x[d];
    }
    for (CeedInt d = 0; d < shape.dim; d++) element.q_ref[d * element.Q + q] = x[d];
    element.q_weights.push_back(weight);
  }
}

/// The element whose functions are combinations of `fields`, each 1 for one functional and 0 for all others.
template <typename Functional>
Tabulated make_element(std::string name, const Shape &shape, CeedFESpace space, CeedInt points,
                       const std::vector<PolynomialField> &fields, const Functional &functional) {
  const std::size_t n = fields.size();
  Tabulated element;
  element.name = std::move(name);
  element.topology = shape.topology;
  element.space = space;
  element.dim = shape.dim;
  element.interpolate = [functional, n](const PolynomialField &field) {
    Values u;
    for (std::size_t i = 0; i < n; i++) u.push_back(functional(field, i));
    return u;
  };
  element.P = static_cast<CeedInt>(n);
  Values moments(n * n), coefficients(n * n, 0);
  for (std::size_t i = 0; i < n; i++) {
    coefficients[i * n + i] = 1;
    for (std::size_t k = 0; k < n; k++) moments[i * n + k] = functional(fields[k], i);
  }
  solve(moments, coefficients, n);
  for (std::size_t j = 0; j < n; j++) {
    PolynomialField shape_function(fields[0].size());
    for (std::size_t k = 0; k < n; k++) {
      for (std::size_t d = 0; d < shape_function.size(); d++)
        shape_function[d].add(coefficients[k * n + j], fields[k][d]);
    }
    element.shapes.push_back(std::move(shape_function));
  }
  make_rule(shape, points, element);
  for (const CeedEvalMode mode : {CEED_EVAL_INTERP, element.derivative_mode()}) {
    Values &matrix = mode == CEED_EVAL_INTERP ? element.interp : element.derivative;
    const CeedInt q_comp = element.q_comp(mode);
    matrix.resize(static_cast<std::size_t>(q_comp) * element.Q * element.P);
    for (CeedInt q = 0; q < element.Q; q++) {
      const Values x = element.point(q);
      for (CeedInt j = 0; j < element.P; j++) {
        const Values values = element.evaluate(element.shapes[j], mode, x.data());
        for (CeedInt g = 0; g < q_comp; g++) matrix[(g * element.Q + q) * element.P + j] = values[g];
      }
    }
  }
  return element;
}

/// Monomials x^a y^b z^c as scalar fields: all with a + b + c <= degree, or with each power <= degree.
std::vector<PolynomialField> monomials(CeedInt dim, int degree, bool is_total) {
  std::vector<PolynomialField> fields;
  for (int c = 0; c <= (dim > 2 ? degree : 0); c++) {
    for (int b = 0; b <= (dim > 1 ? degree : 0); b++) {
      for (int a = 0; a <= degree; a++) {
        if (!is_total || a + b + c <= degree) fields.push_back({monomial(a, b, c)});
      }
    }
  }
  return fields;
}

/// A vector field with one entry that is not zero.
PolynomialField one_entry(CeedInt dim, CeedInt d, Polynomial3 entry) {
  PolynomialField field(static_cast<std::size_t>(dim));
  field[d] = std::move(entry);
  return field;
}

Tabulated lagrange_element(std::string name, const Shape &shape, CeedInt points, const std::vector<Point> &nodes,
                           const std::vector<PolynomialField> &fields) {
  return make_element(std::move(name), shape, CEED_FE_SPACE_H1, points, fields,
                      [nodes](const PolynomialField &field, std::size_t i) { return value(field, nodes[i]); });
}

Tabulated raviart_thomas(std::string name, const Shape &shape, CeedInt points,
                         const std::vector<PolynomialField> &fields) {
  return make_element(
      std::move(name), shape, CEED_FE_SPACE_HDIV, points, fields,
      [shape](const PolynomialField &field, std::size_t i) { return flux(field, shape, shape.faces[i]); });
}

Tabulated nedelec(std::string name, const Shape &shape, CeedInt points, const std::vector<PolynomialField> &fields) {
  return make_element(
      std::move(name), shape, CEED_FE_SPACE_HCURL, points, fields,
      [shape](const PolynomialField &field, std::size_t i) { return circulation(field, shape, shape.edges[i]); });
}

/// Corners and the middles of the edges.
std::vector<Point> quadratic_nodes(const Shape &shape) {
  std::vector<Point> nodes = shape.corners;
  for (const auto &[i, j] : shape.edges) {
    const Point &a = shape.corners[i], &b = shape.corners[j];
    nodes.push_back({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2});
  }
  return nodes;
}

/// Constants, and for RT the field x, on simplices: P_0^d + x P_0.
std::vector<PolynomialField> simplex_rt(CeedInt dim) {
  std::vector<PolynomialField> fields;
  for (CeedInt d = 0; d < dim; d++) fields.push_back(one_entry(dim, d, monomial(0)));
  PolynomialField x;
  for (CeedInt d = 0; d < dim; d++) x.push_back(monomial(d == 0, d == 1, d == 2));
  fields.push_back(std::move(x));
  return fields;
}

/// Constants and rotations about the axes.
std::vector<PolynomialField> simplex_nedelec(CeedInt dim) {
  std::vector<PolynomialField> fields;
  for (CeedInt d = 0; d < dim; d++) fields.push_back(one_entry(dim, d, monomial(0)));
  for (CeedInt axis = dim == 2 ? 2 : 0; axis < 3; axis++) {
    const CeedInt a = (axis + 1) % 3, b = (axis + 2) % 3;
    PolynomialField rotation(static_cast<std::size_t>(dim));
    rotation[a].add(-1, monomial(b == 0, b == 1, b == 2));
    rotation[b].add(1, monomial(a == 0, a == 1, a == 2));
    fields.push_back(std::move(rotation));
  }
  return fields;
}

/// Entry d is linear in x_d (RT) or in all but x_d (Nédélec), and constant in the rest.
std::vector<PolynomialField> box_vectors(CeedInt dim, bool is_rt) {
  std::vector<PolynomialField> fields;
  for (CeedInt d = 0; d < dim; d++) {
    for (int bits = 0; bits < 1 << dim; bits++) {
      const int allowed = is_rt ? 1 << d : ((1 << dim) - 1) ^ (1 << d);
      if ((bits & ~allowed) != 0) continue;
      fields.push_back(one_entry(dim, d, monomial(bits & 1, (bits >> 1) & 1, (bits >> 2) & 1)));
    }
  }
  return fields;
}

}  // namespace

CeedEvalMode derivative_mode(CeedFESpace space) {
  return space == CEED_FE_SPACE_H1 ? CEED_EVAL_GRAD : space == CEED_FE_SPACE_HDIV ? CEED_EVAL_DIV : CEED_EVAL_CURL;
}

CeedInt q_comp(CeedFESpace space, CeedInt dim, CeedEvalMode mode) {
  switch (mode) {
    case CEED_EVAL_INTERP:
      return space == CEED_FE_SPACE_H1 ? 1 : dim;
    case CEED_EVAL_GRAD:
      return dim;
    case CEED_EVAL_CURL:
      return dim == 3 ? 3 : 1;
    default:
      return 1;
  }
}

Values Tabulated::evaluate(const PolynomialField &field, CeedEvalMode mode, const CeedScalar *x) const {
  const auto d = [&](int component, int direction) { return field[component].derivative(direction).at(x); };
  Values result;
  switch (mode) {
    case CEED_EVAL_INTERP:
      for (const Polynomial3 &entry : field) result.push_back(entry.at(x));
      break;
    case CEED_EVAL_GRAD:
      for (CeedInt k = 0; k < dim; k++) result.push_back(d(0, k));
      break;
    case CEED_EVAL_DIV:
      result.push_back(0);
      for (CeedInt k = 0; k < dim; k++) result[0] += d(k, k);
      break;
    default:
      if (dim == 2) {
        result.push_back(d(1, 0) - d(0, 1));
      } else {
        for (int k = 0; k < 3; k++) result.push_back(d((k + 2) % 3, (k + 1) % 3) - d((k + 1) % 3, (k + 2) % 3));
      }
  }
  return result;
}

Values Tabulated::point(CeedInt q) const {
  Values x(3, 0);
  for (CeedInt d = 0; d < dim; d++) x[d] = q_ref[d * Q + q];
  return x;
}

Basis Tabulated::make(Ceed ceed, CeedInt num_comp) const {
  const auto create = space == CEED_FE_SPACE_H1     ? CeedBasisCreateH1
                      : space == CEED_FE_SPACE_HDIV ? CeedBasisCreateHdiv
                                                    : CeedBasisCreateHcurl;
  Basis basis;
  ok(create(ceed, topology, num_comp, P, Q, interp.data(), derivative.data(), q_ref.data(), q_weights.data(),
            basis.out()));
  return basis;
}

std::vector<Tabulated> tabulated_elements(CeedInt points) {
  std::vector<PolynomialField> prism_fields;
  for (const auto &[a, b] : {std::pair{0, 0}, {1, 0}, {0, 1}}) {
    for (int c = 0; c < 2; c++) prism_fields.push_back({monomial(a, b, c)});
  }
  std::vector<Tabulated> all;
  all.push_back(lagrange_element("P1 line", line, points, line.corners, monomials(1, 1, true)));
  all.push_back(lagrange_element("P1 triangle", triangle, points, triangle.corners, monomials(2, 1, true)));
  all.push_back(lagrange_element("P2 triangle", triangle, points, quadratic_nodes(triangle), monomials(2, 2, true)));
  all.push_back(lagrange_element("Q1 quadrilateral", quad, points, quad.corners, monomials(2, 1, false)));
  all.push_back(lagrange_element("P1 tetrahedron", tet, points, tet.corners, monomials(3, 1, true)));
  all.push_back(lagrange_element("P2 tetrahedron", tet, points, quadratic_nodes(tet), monomials(3, 2, true)));
  all.push_back(lagrange_element("P1 prism", prism, points, prism.corners, prism_fields));
  all.push_back(lagrange_element("Q1 hexahedron", hex, points, hex.corners, monomials(3, 1, false)));
  all.push_back(raviart_thomas("RT0 triangle", triangle, points, simplex_rt(2)));
  all.push_back(raviart_thomas("RT0 quadrilateral", quad, points, box_vectors(2, true)));
  all.push_back(raviart_thomas("RT0 tetrahedron", tet, points, simplex_rt(3)));
  all.push_back(raviart_thomas("RT0 hexahedron", hex, points, box_vectors(3, true)));
  all.push_back(nedelec("Nedelec triangle", triangle, points, simplex_nedelec(2)));
  all.push_back(nedelec("Nedelec quadrilateral", quad, points, box_vectors(2, false)));
  all.push_back(nedelec("Nedelec tetrahedron", tet, points, simplex_nedelec(3)));
  all.push_back(nedelec("Nedelec hexahedron", hex, points, box_vectors(3, false)));
  return all;
}

Tabulated tabulated(const std::string &name, CeedInt points) {
  for (Tabulated &element : tabulated_elements(points)) {
    if (element.name == name) return std::move(element);
  }
  throw std::logic_error("no element is called " + name);
}

Values dense_apply(const Values &matrix, CeedInt q_comp, CeedInt Q, CeedInt P, CeedInt num_comp, CeedInt num_elem,
                   CeedTransposeMode t_mode, const Values &u) {
  const bool is_transpose = t_mode == CEED_TRANSPOSE;
  const std::size_t at_nodes = static_cast<std::size_t>(P) * num_comp,
                    at_points = static_cast<std::size_t>(Q) * num_comp * q_comp;
  Values v(num_elem * (is_transpose ? at_nodes : at_points), 0);
  for (CeedInt e = 0; e < num_elem; e++) {
    for (CeedInt g = 0; g < q_comp; g++) {
      for (CeedInt c = 0; c < num_comp; c++) {
        for (CeedInt q = 0; q < Q; q++) {
          for (CeedInt n = 0; n < P; n++) {
            const CeedScalar entry = matrix[(static_cast<std::size_t>(g) * Q + q) * P + n];
            const std::size_t node = e * at_nodes + c * P + n;
            const std::size_t point = e * at_points + (static_cast<std::size_t>(g) * num_comp + c) * Q + q;
            v[is_transpose ? node : point] += entry * u[is_transpose ? point : node];
          }
        }
      }
    }
  }
  return v;
}

}  // namespace hg::test
