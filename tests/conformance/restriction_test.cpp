// Element restrictions on every backend: the map against its definition, adjointness, linearity, multiplicity.
#include <functional>
#include <vector>

#include "backends.hpp"

namespace {

using namespace hg::test;

/// A restriction and, from its definition, the place in the L-vector of each entry of each element: of component c of
/// node n at places[e][c*num_nodes + n].
struct Map {
  Restriction rstr;
  CeedSize l_size = 0;
  CeedInt num_comp = 0;
  std::vector<std::vector<CeedSize>> places;
};

class RestrictionConformance : public BackendTest {
 protected:
  Map with_offsets() {
    Map map;
    const CeedInt num_elem = random.integer(1, 12), elem_size = random.integer(1, 9), num_nodes = 20;
    map.num_comp = random.integer(1, 4);
    // Components next to each other, or one component after another with room between them.
    const bool is_interlaced = random.chance(0.5);
    const CeedInt comp_stride = is_interlaced ? 1 : num_nodes + random.integer(0, 3);
    const CeedInt node_stride = is_interlaced ? map.num_comp : 1;
    map.l_size = is_interlaced ? num_nodes * map.num_comp : comp_stride * map.num_comp;
    std::vector<CeedInt> offsets(static_cast<std::size_t>(num_elem) * elem_size);
    for (CeedInt &offset : offsets) offset = random.integer(0, num_nodes - 1) * node_stride;
    for (CeedInt e = 0; e < num_elem; e++) {
      auto &places = map.places.emplace_back();
      for (CeedInt c = 0; c < map.num_comp; c++) {
        for (CeedInt n = 0; n < elem_size; n++)
          places.push_back(offsets[e * elem_size + n] + CeedSize{c} * comp_stride);
      }
    }
    ok(CeedElemRestrictionCreate(ceed, num_elem, elem_size, map.num_comp, comp_stride, map.l_size, CEED_MEM_HOST,
                                 CEED_COPY_VALUES, offsets.data(), map.rstr.out()));
    return map;
  }

  Map strided() {
    Map map;
    const CeedInt num_elem = random.integer(1, 12), elem_size = random.integer(1, 9);
    map.num_comp = random.integer(1, 4);
    map.l_size = CeedSize{num_elem} * elem_size * map.num_comp;
    CeedInt strides[3];
    switch (random.integer(0, 3)) {
      case 0:  // (node, component, element)
        strides[0] = 1, strides[1] = elem_size, strides[2] = elem_size * map.num_comp;
        break;
      case 1:  // (component, node, element)
        strides[0] = map.num_comp, strides[1] = 1, strides[2] = elem_size * map.num_comp;
        break;
      case 2:  // (node, element, component)
        strides[0] = 1, strides[1] = elem_size * num_elem, strides[2] = elem_size;
        break;
      default:  // (element, node, component)
        strides[0] = num_elem, strides[1] = elem_size * num_elem, strides[2] = 1;
    }
    for (CeedInt e = 0; e < num_elem; e++) {
      auto &places = map.places.emplace_back();
      for (CeedInt c = 0; c < map.num_comp; c++) {
        for (CeedInt n = 0; n < elem_size; n++) {
          places.push_back(CeedSize{n} * strides[0] + CeedSize{c} * strides[1] + CeedSize{e} * strides[2]);
        }
      }
    }
    ok(CeedElemRestrictionCreateStrided(ceed, num_elem, elem_size, map.num_comp, map.l_size, strides, map.rstr.out()));
    return map;
  }

  Map at_points() {
    Map map;
    const CeedInt num_elem = random.integer(1, 12);
    map.num_comp = random.integer(1, 4);
    std::vector<CeedInt> counts(static_cast<std::size_t>(num_elem));
    CeedInt num_points = 0;
    for (CeedInt &count : counts) {
      count = random.chance(0.3) ? 0 : random.integer(1, 9);
      num_points += count;
    }
    const CeedInt num_places = num_points + random.integer(0, 3);
    map.l_size = CeedSize{num_places} * map.num_comp;
    const std::vector<CeedInt> points = random.distinct(num_points, num_places);
    std::vector<CeedInt> offsets{num_elem + 1};
    for (const CeedInt count : counts) offsets.push_back(offsets.back() + count);
    offsets.insert(offsets.end(), points.begin(), points.end());
    for (CeedInt e = 0; e < num_elem; e++) {
      auto &places = map.places.emplace_back();
      for (CeedInt c = 0; c < map.num_comp; c++) {
        for (CeedInt p = 0; p < counts[e]; p++) {
          places.push_back(CeedSize{offsets[offsets[e] + p]} * map.num_comp + c);
        }
      }
    }
    ok(CeedElemRestrictionCreateAtPoints(ceed, num_elem, num_points, map.num_comp, map.l_size, CEED_MEM_HOST,
                                         CEED_COPY_VALUES, offsets.data(), map.rstr.out()));
    return map;
  }

  /// Runs `check` on restrictions of all kinds.
  void for_maps(const std::function<void(const Map &)> &check) {
    for (int round = 0; round < 25; round++) {
      SCOPED_TRACE("round " + std::to_string(round));
      {
        SCOPED_TRACE("with offsets");
        check(with_offsets());
      }
      {
        SCOPED_TRACE("strided");
        check(strided());
      }
      {
        SCOPED_TRACE("at points");
        check(at_points());
      }
      if (HasFailure()) return;
    }
  }

  /// Place in the E-vector, as the backend tells it, of component c of node n of element e.
  static CeedSize e_place(const Map &map, CeedInt e, CeedInt n, CeedInt c) {
    bool is_points = false;
    ok(CeedElemRestrictionIsAtPoints(map.rstr, &is_points));
    CeedInt layout[3];
    ok(CeedElemRestrictionGetELayout(map.rstr, layout));
    if (!is_points) return CeedSize{n} * layout[0] + CeedSize{c} * layout[1] + CeedSize{e} * layout[2];
    CeedSize start = 0;
    ok(CeedElemRestrictionGetAtPointsElementOffset(map.rstr, e, &start));
    return start + CeedSize{c} * num_nodes(map, e) + CeedSize{n} * layout[0];
  }
  static CeedInt num_nodes(const Map &map, CeedInt e) {
    return static_cast<CeedInt>(map.places[e].size()) / map.num_comp;
  }

  Values apply(const Map &map, CeedTransposeMode mode, const Values &input, const Values &output) {
    Vector u = make_vector(ceed, input), v = make_vector(ceed, output);
    ok(CeedElemRestrictionApply(map.rstr, mode, u, v, CEED_REQUEST_IMMEDIATE));
    EXPECT_EQ(values_of(u), input) << "the input stays";
    return values_of(v);
  }
  static CeedSize e_size(const Map &map) {
    CeedSize size = 0;
    ok(CeedElemRestrictionGetEVectorSize(map.rstr, &size));
    return size;
  }
  static Values zeros(CeedSize size) { return Values(static_cast<std::size_t>(size), 0.0); }

  Random random{30};
};

TEST_P(RestrictionConformance, GathersWhatItsDefinitionSays) {
  for_maps([&](const Map &map) {
    const Values l = random.reals(map.l_size);
    const Values e_values = apply(map, CEED_NOTRANSPOSE, l, Values(zeros(e_size(map)).size(), -3.0));
    for (CeedInt e = 0; e < static_cast<CeedInt>(map.places.size()); e++) {
      for (CeedInt c = 0; c < map.num_comp; c++) {
        for (CeedInt n = 0; n < num_nodes(map, e); n++) {
          EXPECT_EQ(e_values[e_place(map, e, n, c)], l[map.places[e][c * num_nodes(map, e) + n]])
              << "element " << e << ", node " << n << ", component " << c;
        }
      }
    }
  });
}

TEST_P(RestrictionConformance, ScattersByAdding) {
  for_maps([&](const Map &map) {
    const Values e_values = random.reals(e_size(map)), l = random.reals(map.l_size);
    Values want = l;
    for (CeedInt e = 0; e < static_cast<CeedInt>(map.places.size()); e++) {
      for (CeedInt c = 0; c < map.num_comp; c++) {
        for (CeedInt n = 0; n < num_nodes(map, e); n++) {
          want[map.places[e][c * num_nodes(map, e) + n]] += e_values[e_place(map, e, n, c)];
        }
      }
    }
    expect_close(apply(map, CEED_TRANSPOSE, e_values, l), want, tolerance(e_size(map)), "l + R^T e", 1);
  });
}

TEST_P(RestrictionConformance, IsAdjointToItsTransposeAndLinear) {
  for_maps([&](const Map &map) {
    const auto gather = [&](const Values &l) { return apply(map, CEED_NOTRANSPOSE, l, zeros(e_size(map))); };
    const auto scatter = [&](const Values &e) { return apply(map, CEED_TRANSPOSE, e, zeros(map.l_size)); };
    const CeedScalar tol = tolerance(e_size(map) + map.l_size);
    expect_adjoint(gather, scatter, map.l_size, e_size(map), random, tol, "restriction");
    expect_linear(gather, map.l_size, random, tol, "gather");
    expect_linear(scatter, e_size(map), random, tol, "scatter");
  });
}

TEST_P(RestrictionConformance, MultiplicityIsWhatScattersFromOnes) {
  for_maps([&](const Map &map) {
    Vector multiplicity;
    ok(CeedVectorCreate(ceed, map.l_size, multiplicity.out()));
    ok(CeedElemRestrictionGetMultiplicity(map.rstr, multiplicity));
    EXPECT_EQ(values_of(multiplicity),
              apply(map, CEED_TRANSPOSE, Values(zeros(e_size(map)).size(), 1.0), zeros(map.l_size)));
    // Scattering what was gathered multiplies by it.
    const Values l = random.reals(map.l_size);
    const Values there_and_back =
        apply(map, CEED_TRANSPOSE, apply(map, CEED_NOTRANSPOSE, l, zeros(e_size(map))), zeros(map.l_size));
    Values want = values_of(multiplicity);
    for (std::size_t i = 0; i < want.size(); i++) want[i] *= l[i];
    expect_close(there_and_back, want, tolerance(e_size(map)), "R^T R l", 1);
  });
}

TEST_P(RestrictionConformance, WorksOnTheVectorsItMakes) {
  for_maps([&](const Map &map) {
    Vector l, e;
    ok(CeedElemRestrictionCreateVector(map.rstr, l.out(), e.out()));
    EXPECT_EQ(length_of(l), map.l_size);
    EXPECT_EQ(length_of(e), e_size(map));
    ok(CeedVectorSetValue(l, 2.0));
    ok(CeedElemRestrictionApply(map.rstr, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE));
    if (e_size(map) > 0) {
      EXPECT_EQ(values_of(e), Values(zeros(e_size(map)).size(), 2.0));
    }
    ok(CeedElemRestrictionCreateVector(map.rstr, nullptr, nullptr));
  });
}

TEST_P(RestrictionConformance, LeavesWhatLiesBeyondItsVectors) {
  for_maps([&](const Map &map) {
    const Values l = random.reals(map.l_size + 3);
    const CeedSize size = e_size(map);
    const Values e = apply(map, CEED_NOTRANSPOSE, l, Values(static_cast<std::size_t>(size + 2), 8.0));
    for (CeedSize i = size; size > 0 && i < size + 2; i++) EXPECT_EQ(e[i], 8.0);
    const Values back = apply(map, CEED_TRANSPOSE, e, l);
    for (CeedSize i = map.l_size; i < map.l_size + 3; i++) EXPECT_EQ(back[i], l[i]);
  });
}

TEST_P(RestrictionConformance, StridesOfTheBackendAreAnyOneToOneMap) {
  const CeedInt num_elem = 5, elem_size = 3, num_comp = 2;
  const CeedSize size = num_elem * elem_size * num_comp;
  Map map;
  map.l_size = size;
  map.num_comp = num_comp;
  ok(CeedElemRestrictionCreateStrided(ceed, num_elem, elem_size, num_comp, size, CEED_STRIDES_BACKEND, map.rstr.out()));
  CeedInt layout[3];
  ok(CeedElemRestrictionGetLLayout(map.rstr, layout));
  for (CeedInt e = 0; e < num_elem; e++) {
    auto &places = map.places.emplace_back();
    for (CeedInt c = 0; c < num_comp; c++) {
      for (CeedInt n = 0; n < elem_size; n++) {
        places.push_back(CeedSize{n} * layout[0] + CeedSize{c} * layout[1] + CeedSize{e} * layout[2]);
      }
    }
  }
  const Values l = random.reals(size);
  const Values e_values = apply(map, CEED_NOTRANSPOSE, l, zeros(size));
  for (CeedInt e = 0; e < num_elem; e++) {
    for (CeedInt c = 0; c < num_comp; c++) {
      for (CeedInt n = 0; n < elem_size; n++) {
        EXPECT_EQ(e_values[e_place(map, e, n, c)], l[map.places[e][c * elem_size + n]]);
      }
    }
  }
  EXPECT_EQ(apply(map, CEED_TRANSPOSE, e_values, zeros(size)), l);
}

TEST_P(RestrictionConformance, ServesThePointsOfOneElement) {
  for (int round = 0; round < 25; round++) {
    const Map map = at_points();
    const Values l = random.reals(map.l_size);
    CeedInt longest = 0;
    ok(CeedElemRestrictionGetMaxPointsInElement(map.rstr, &longest));
    const CeedSize room = CeedSize{longest} * map.num_comp + 1;
    for (CeedInt e = 0; e < static_cast<CeedInt>(map.places.size()); e++) {
      const auto size = static_cast<CeedSize>(map.places[e].size());
      Vector l_vector = make_vector(ceed, l), e_vector = make_vector(ceed, room, -5.0);
      ok(CeedElemRestrictionApplyAtPointsInElement(map.rstr, e, CEED_NOTRANSPOSE, l_vector, e_vector,
                                                   CEED_REQUEST_IMMEDIATE));
      const Values got = values_of(e_vector);
      for (CeedSize i = 0; i < size; i++) EXPECT_EQ(got[i], l[map.places[e][i]]) << "element " << e << ", entry " << i;
      for (CeedSize i = size; i < room; i++) EXPECT_EQ(got[i], -5.0) << "beyond the element's points";

      const Values values = random.reals(room);
      set_values(e_vector, values);
      ok(CeedElemRestrictionApplyAtPointsInElement(map.rstr, e, CEED_TRANSPOSE, e_vector, l_vector,
                                                   CEED_REQUEST_IMMEDIATE));
      Values want = l;
      for (CeedSize i = 0; i < size; i++) want[map.places[e][i]] += values[i];
      expect_close(values_of(l_vector), want, tolerance(2), "l + R_e^T values", 1);
    }
  }
}

TEST_P(RestrictionConformance, LetsElementsShareAPoint) {
  // Point 1 belongs to both elements.
  const std::vector<CeedInt> offsets{3, 5, 7, 0, 1, 1, 2};
  Restriction rstr;
  ok(CeedElemRestrictionCreateAtPoints(ceed, 2, 3, 1, 3, CEED_MEM_HOST, CEED_COPY_VALUES, offsets.data(), rstr.out()));
  Vector l = make_vector(ceed, Values{1, 2, 3}), e = make_vector(ceed, 4, 0.0);
  ok(CeedElemRestrictionApply(rstr, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(e), (Values{1, 2, 2, 3}));
  ok(CeedElemRestrictionApply(rstr, CEED_TRANSPOSE, e, l, CEED_REQUEST_IMMEDIATE));
  EXPECT_EQ(values_of(l), (Values{2, 6, 6}));
}

INSTANTIATE_TEST_SUITE_P(Backends, RestrictionConformance, testing::ValuesIn(usable_backends()), backend_name);

}  // namespace
