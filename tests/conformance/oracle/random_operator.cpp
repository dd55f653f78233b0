#include "random_operator.hpp"

#include <algorithm>
#include <numeric>

namespace hg::test {

Layout random_layout(Random &random, const OperatorWishes &wishes) {
  Layout layout;
  const CeedInt num_comp = random.integer(1, wishes.max_comp), num_nodes = random.integer(20, 32);
  layout.in = static_cast<CeedSize>(num_nodes) * num_comp;
  layout.out = wishes.is_square || wishes.has_point_blocks ? layout.in : layout.in + random.integer(0, 9);
  if (!wishes.has_point_blocks) return layout;
  layout.num_comp = num_comp;
  layout.comp_stride = random.chance(0.5) ? 1 : num_nodes;
  return layout;
}

RandomOperator::RandomOperator(Ceed ceed, Random &random, const OperatorWishes &wishes, const Layout &layout)
    : ceed_(ceed),
      random_(random),
      wishes_(wishes),
      layout_(layout),
      num_elem_(random.integer(1, 5)),
      Q_1d_(random.integer(2, wishes.dim == 3 ? 3 : 4)) {
  if (wishes_.at_points) {
    for (CeedInt e = 0; e < num_elem_; e++) num_points_.push_back(random.chance(0.3) ? 0 : random.integer(1, 7));
    num_points_[random.integer(0, num_elem_ - 1)] = random.integer(1, 7);
  } else {
    num_points_.assign(num_elem_, CeedIntPow(Q_1d_, wishes_.dim));
  }
  total_points_ = std::accumulate(num_points_.begin(), num_points_.end(), 0);
  Q_ = *std::max_element(num_points_.begin(), num_points_.end());
  add_passive();
  const CeedInt num_spaces = random.integer(1, wishes_.max_active_spaces);
  for (CeedInt i = 0; i < num_spaces; i++) add_active(inputs_, layout_.in);
  if (layout_.in == layout_.out) {
    // Some of the same spaces, in other modes.
    for (const BlendField &field : std::vector<BlendField>(inputs_)) {
      if (field.vec != CEED_VECTOR_ACTIVE || random.chance(0.3)) continue;
      outputs_.push_back(field);
      description_ += ", out: the same";
    }
  }
  if (outputs_.empty() || random.chance(0.4)) add_active(outputs_, layout_.out);
  compose();
}

CeedBasis RandomOperator::make_basis(CeedInt num_comp, CeedInt &num_nodes, CeedEvalMode &derivative) {
  const CeedInt dim = wishes_.dim;
  Basis &basis = bases_.emplace_back();
  derivative = CEED_EVAL_GRAD;
  const CeedInt kind = wishes_.at_points ? 0 : random_.integer(0, 3);
  if (kind == 0 || (kind > 1 && dim == 1)) {
    const CeedInt P_1d = random_.integer(2, wishes_.at_points ? Q_1d_ : dim == 3 ? 2 : 3);
    ok(CeedBasisCreateTensorH1Lagrange(ceed_, dim, num_comp, P_1d, Q_1d_, CEED_GAUSS, basis.out()));
    num_nodes = CeedIntPow(P_1d, dim);
    description_ += " tensor";
    return basis;
  }
  static const CeedElemTopology topologies[] = {CEED_TOPOLOGY_LINE, CEED_TOPOLOGY_QUAD, CEED_TOPOLOGY_HEX};
  num_nodes = random_.integer(2, 9);
  const CeedElemTopology topology = topologies[dim - 1];
  const Values values = random_.reals(static_cast<CeedSize>(dim) * Q_ * num_nodes),
               derivatives = random_.reals(static_cast<CeedSize>(3) * Q_ * num_nodes), points = random_.reals(dim * Q_),
               weights = random_.reals(Q_, 0.1, 1);
  if (kind == 1) {
    ok(CeedBasisCreateH1(ceed_, topology, num_comp, num_nodes, Q_, values.data(), derivatives.data(), points.data(),
                         weights.data(), basis.out()));
    description_ += " H1";
  } else if (kind == 2) {
    ok(CeedBasisCreateHdiv(ceed_, topology, num_comp, num_nodes, Q_, values.data(), derivatives.data(), points.data(),
                           weights.data(), basis.out()));
    derivative = CEED_EVAL_DIV;
    description_ += " Hdiv";
  } else {
    ok(CeedBasisCreateHcurl(ceed_, topology, num_comp, num_nodes, Q_, values.data(), derivatives.data(), points.data(),
                            weights.data(), basis.out()));
    derivative = CEED_EVAL_CURL;
    description_ += " Hcurl";
  }
  return basis;
}

CeedElemRestriction RandomOperator::make_restriction(CeedInt elem_size, CeedInt num_comp, CeedInt comp_stride,
                                                     CeedSize l_size) {
  Restriction &rstr = restrictions_.emplace_back();
  const bool is_interleaved = comp_stride == 1 && num_comp > 1;
  const auto num_places = static_cast<CeedInt>(l_size / num_comp);
  std::vector<CeedInt> offsets;
  for (CeedInt e = 0; e < num_elem_; e++) {
    std::vector<CeedInt> nodes = random_.distinct(std::min(elem_size, num_places), num_places);
    while (static_cast<CeedInt>(nodes.size()) < elem_size) nodes.push_back(nodes.front());
    if (random_.chance(0.1)) nodes.back() = nodes.front();  // an element that meets a node twice
    for (const CeedInt node : nodes) offsets.push_back(is_interleaved ? node * num_comp : node);
  }
  description_ += " on " + std::to_string(num_comp) + " components";
  switch (random_.integer(0, 4)) {
    case 0: {
      const auto signs = std::make_unique<bool[]>(offsets.size());
      for (std::size_t i = 0; i < offsets.size(); i++) signs[i] = random_.chance(0.5);
      ok(CeedElemRestrictionCreateOriented(ceed_, num_elem_, elem_size, num_comp, comp_stride, l_size, CEED_MEM_HOST,
                                           CEED_COPY_VALUES, offsets.data(), signs.get(), rstr.out()));
      description_ += ", oriented";
      break;
    }
    case 1: {
      std::vector<CeedInt8> bands(3 * offsets.size());
      for (CeedInt8 &entry : bands) entry = static_cast<CeedInt8>(random_.integer(-1, 1));
      ok(CeedElemRestrictionCreateCurlOriented(ceed_, num_elem_, elem_size, num_comp, comp_stride, l_size,
                                               CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(), bands.data(),
                                               rstr.out()));
      description_ += ", curl-oriented";
      break;
    }
    case 2:
      ok(CeedElemRestrictionCreateBlocked(ceed_, num_elem_, elem_size, random_.integer(1, 4), num_comp, comp_stride,
                                          l_size, CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(), rstr.out()));
      description_ += ", blocked";
      break;
    default:
      ok(CeedElemRestrictionCreate(ceed_, num_elem_, elem_size, num_comp, comp_stride, l_size, CEED_MEM_HOST,
                                   CEED_COPY_VALUES, offsets.data(), rstr.out()));
  }
  return rstr;
}

CeedElemRestriction RandomOperator::make_point_restriction(CeedInt num_comp, CeedSize l_size) {
  if (point_list_.empty()) {
    for (CeedInt e = 0, start = num_elem_ + 1; e <= num_elem_; e++) {
      point_list_.push_back(start);
      if (e < num_elem_) start += num_points_[e];
    }
    const std::vector<CeedInt> numbers = random_.distinct(total_points_, total_points_);
    point_list_.insert(point_list_.end(), numbers.begin(), numbers.end());
  }
  Restriction &rstr = restrictions_.emplace_back();
  ok(CeedElemRestrictionCreateAtPoints(ceed_, num_elem_, total_points_, num_comp, l_size, CEED_MEM_HOST,
                                       CEED_COPY_VALUES, point_list_.data(), rstr.out()));
  return rstr;
}

void RandomOperator::add_active(std::vector<BlendField> &fields, CeedSize l_size) {
  const CeedInt num_comp = layout_.num_comp > 0 ? layout_.num_comp : random_.integer(1, std::min(wishes_.max_comp, 3)),
                comp_stride = layout_.num_comp > 0  ? layout_.comp_stride
                              : random_.chance(0.5) ? 1
                                                    : static_cast<CeedInt>(l_size / num_comp);
  description_ += &fields == &inputs_ ? ", in:" : ", out:";
  // Nodes that are points: at points of the same kind as the points, which stand component by component.
  const bool fits_points = !wishes_.at_points || (total_points_ <= l_size / num_comp && comp_stride == 1);
  if (fits_points && random_.chance(0.25)) {
    const CeedElemRestriction rstr = wishes_.at_points ? make_point_restriction(num_comp, l_size)
                                                       : make_restriction(Q_, num_comp, comp_stride, l_size);
    fields.push_back({CEED_EVAL_NONE, num_comp, rstr, CEED_BASIS_NONE, CEED_VECTOR_ACTIVE});
    description_ += " none";
    return;
  }
  CeedInt num_nodes = 0, q_comp = 0;
  CeedEvalMode derivative = CEED_EVAL_NONE;
  const CeedBasis basis = make_basis(num_comp, num_nodes, derivative);
  const CeedElemRestriction rstr = make_restriction(num_nodes, num_comp, comp_stride, l_size);
  const CeedInt modes = random_.integer(1, 3);
  for (const CeedEvalMode mode : {CEED_EVAL_INTERP, derivative}) {
    if ((modes & (mode == CEED_EVAL_INTERP ? 1 : 2)) == 0) continue;
    ok(CeedBasisGetNumQuadratureComponents(basis, mode, &q_comp));
    fields.push_back({mode, num_comp * q_comp, rstr, basis, CEED_VECTOR_ACTIVE});
    description_ += std::string(" ") + CeedEvalModes[mode];
  }
}

void RandomOperator::add_passive() {
  Basis &weights = bases_.emplace_back();
  ok(CeedBasisCreateTensorH1Lagrange(ceed_, wishes_.dim, 1, 2, Q_1d_, CEED_GAUSS, weights.out()));
  inputs_.push_back({CEED_EVAL_WEIGHT, 1, CEED_ELEMRESTRICTION_NONE, weights, CEED_VECTOR_NONE});
  const CeedSize l_size = total_points_;
  CeedElemRestriction rstr = nullptr;
  if (wishes_.at_points) {
    rstr = make_point_restriction(1, l_size);
  } else {
    Restriction &strided = restrictions_.emplace_back();
    const CeedInt strides[3] = {1, Q_, Q_};
    ok(CeedElemRestrictionCreateStrided(ceed_, num_elem_, Q_, 1, l_size, strides, strided.out()));
    rstr = strided;
  }
  vectors_.push_back(make_vector(ceed_, random_.reals(l_size)));
  inputs_.push_back({CEED_EVAL_NONE, 1, rstr, CEED_BASIS_NONE, vectors_.back()});
}

void RandomOperator::compose() {
  // The QFunction sees fields in a random order.
  for (std::vector<BlendField> *fields : {&inputs_, &outputs_}) {
    for (std::size_t i = 1; i < fields->size(); i++) {
      std::swap((*fields)[i], (*fields)[random_.integer(0, static_cast<CeedInt>(i))]);
    }
  }
  BlendPoints points;
  if (wishes_.at_points) {
    const CeedSize size = static_cast<CeedSize>(total_points_) * wishes_.dim;
    vectors_.push_back(make_vector(ceed_, random_.reals(size)));
    points = {make_point_restriction(wishes_.dim, size), vectors_.back()};
  }
  op_ = make_blend(ceed_, random_.integer(0, 1000), inputs_, outputs_, points);
}

}  // namespace hg::test
