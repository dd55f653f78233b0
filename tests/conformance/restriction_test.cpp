// Element restrictions on every backend: the map against its definition, adjointness, linearity, multiplicity.
#include <functional>
#include <vector>

#include "backends.hpp"
#include "oracle/restriction_case.hpp"

namespace {

using namespace hg::test;

/// A case, its restriction, and what is asked of them all the time.
struct Map {
  Map(Ceed ceed, RestrictionCase c_) : c(std::move(c_)), rstr(make_restriction(ceed, c)) {}

  CeedSize e_size() const {
    CeedSize size = 0;
    ok(CeedElemRestrictionGetEVectorSize(rstr, &size));
    return size;
  }
  /// Calls f(e, n, component).
  template <typename F>
  void for_each_value(F &&f) const {
    for (CeedInt e = 0; e < c.num_elem; e++) {
      for (CeedInt comp = 0; comp < c.num_comp; comp++) {
        for (CeedInt n = 0; n < c.num_nodes(e); n++) f(e, n, comp);
      }
    }
  }
  /// An E-vector that is `value` where it belongs to an element, and zero elsewhere.
  Values e_values(const std::function<CeedScalar()> &value) const {
    Values values(static_cast<std::size_t>(e_size()), 0.0);
    for_each_value([&](CeedInt e, CeedInt n, CeedInt comp) { values[e_place(rstr, e, n, comp)] = value(); });
    return values;
  }
  /// l + R^T e, by definition.
  Values scattered(const Values &e_vector, Values l) const {
    for_each_value([&](CeedInt e, CeedInt n, CeedInt comp) {
      for (const auto &term : c.terms(e, n, comp)) {
        l[term.place] += term.coefficient * e_vector[e_place(rstr, e, n, comp)];
      }
    });
    return l;
  }
  Values apply(CeedTransposeMode mode, const Values &input, const Values &output) const {
    Ceed ceed = CeedElemRestrictionReturnCeed(rstr);
    Vector u = make_vector(ceed, input), v = make_vector(ceed, output);
    ok(CeedElemRestrictionApply(rstr, mode, u, v, CEED_REQUEST_IMMEDIATE));
    EXPECT_EQ(values_of(u), input) << "the input stays";
    return values_of(v);
  }

  RestrictionCase c;
  Restriction rstr;
};

Values zeros(CeedSize size) {
  return Values(static_cast<std::size_t>(size), 0.0);
}

/// Expects that the restriction gathers what the definition says.
void expect_gathers(const Map &map, Random &random) {
  const Values l = random.reals(map.c.l_size);
  const Values e_values = map.apply(CEED_NOTRANSPOSE, l, Values(zeros(map.e_size()).size(), -3.0));
  map.for_each_value([&](CeedInt e, CeedInt n, CeedInt comp) {
    CeedScalar want = 0;
    for (const auto &term : map.c.terms(e, n, comp)) want += term.coefficient * l[term.place];
    EXPECT_NEAR(e_values[e_place(map.rstr, e, n, comp)], want, tolerance(3) * 6)
        << "element " << e << ", node " << n << ", component " << comp;
  });
}

class RestrictionConformance : public BackendTest {
 protected:
  /// Runs `check` on restrictions of all kinds.
  void for_maps(const std::function<void(const Map &)> &check) {
    const CeedRestrictionType types[] = {CEED_RESTRICTION_STANDARD, CEED_RESTRICTION_ORIENTED,
                                         CEED_RESTRICTION_CURL_ORIENTED, CEED_RESTRICTION_STRIDED,
                                         CEED_RESTRICTION_POINTS};
    for (int round = 0; round < 25; round++) {
      for (const CeedRestrictionType type : types) {
        for (const bool is_blocked : {false, true}) {
          if (is_blocked && type == CEED_RESTRICTION_POINTS) continue;
          const Map map(ceed, random_restriction(random, type, is_blocked));
          SCOPED_TRACE("round " + std::to_string(round) + ": " + describe(map.c));
          check(map);
          if (HasFailure()) return;
        }
      }
    }
  }

  Random random{30};
};

TEST_P(RestrictionConformance, GathersWhatItsDefinitionSays) {
  for_maps([&](const Map &map) { expect_gathers(map, random); });
}

TEST_P(RestrictionConformance, ScattersByAdding) {
  for_maps([&](const Map &map) {
    // What belongs to no element must not matter.
    const Values e_values = random.reals(map.e_size()), l = random.reals(map.c.l_size);
    expect_close(map.apply(CEED_TRANSPOSE, e_values, l), map.scattered(e_values, l), tolerance(4 * map.e_size()),
                 "l + R^T e", 1);
  });
}

TEST_P(RestrictionConformance, IsAdjointToItsTransposeAndLinear) {
  for_maps([&](const Map &map) {
    // On E-vectors that are zero where they belong to no element.
    const Values elements = map.e_values([] { return 1.0; });
    const auto only_elements = [&](Values e) {
      for (std::size_t i = 0; i < e.size(); i++) e[i] *= elements[i];
      return e;
    };
    const auto gather = [&](const Values &l) {
      return only_elements(map.apply(CEED_NOTRANSPOSE, l, zeros(map.e_size())));
    };
    const auto scatter = [&](const Values &e) {
      return map.apply(CEED_TRANSPOSE, only_elements(e), zeros(map.c.l_size));
    };
    const CeedScalar tol = tolerance(4 * (map.e_size() + map.c.l_size));
    expect_adjoint(gather, scatter, map.c.l_size, map.e_size(), random, tol, "restriction");
    expect_linear(gather, map.c.l_size, random, tol, "gather");
    expect_linear(scatter, map.e_size(), random, tol, "scatter");
  });
}

TEST_P(RestrictionConformance, MultiplicityCountsElements) {
  for_maps([&](const Map &map) {
    const Vector multiplicity = make_vector(ceed, map.c.l_size + 2, 7.0);
    ok(CeedElemRestrictionGetMultiplicity(map.rstr, multiplicity));
    // By definition R^T 1 of the restriction without orientation.
    const Map unoriented(ceed, without_orientation(map.c));
    const Values ones(zeros(map.e_size()).size(), 1.0);
    const Values want = unoriented.apply(CEED_TRANSPOSE, ones, zeros(map.c.l_size + 2));
    EXPECT_EQ(values_of(multiplicity), want);
    if (map.c.type == CEED_RESTRICTION_CURL_ORIENTED) return;
    // Scattering what was gathered multiplies by it, signs or not.
    const Values l = random.reals(map.c.l_size);
    const Values there_and_back =
        map.apply(CEED_TRANSPOSE, map.apply(CEED_NOTRANSPOSE, l, zeros(map.e_size())), zeros(map.c.l_size));
    Values scaled(l.size());
    for (std::size_t i = 0; i < l.size(); i++) scaled[i] = want[i] * l[i];
    expect_close(there_and_back, scaled, tolerance(map.e_size()), "R^T R l", 1);
  });
}

TEST_P(RestrictionConformance, WorksOnTheVectorsItMakes) {
  for_maps([&](const Map &map) {
    Vector l, e;
    ok(CeedElemRestrictionCreateVector(map.rstr, l.out(), e.out()));
    EXPECT_EQ(length_of(l), map.c.l_size);
    EXPECT_EQ(length_of(e), map.e_size());
    const Values values = random.reals(map.c.l_size);
    set_values(l, values);
    ok(CeedElemRestrictionApply(map.rstr, CEED_NOTRANSPOSE, l, e, CEED_REQUEST_IMMEDIATE));
    if (map.e_size() > 0) {
      const Values got = values_of(e), want = map.apply(CEED_NOTRANSPOSE, values, zeros(map.e_size()));
      map.for_each_value([&](CeedInt elem, CeedInt n, CeedInt comp) {
        const CeedSize i = e_place(map.rstr, elem, n, comp);
        EXPECT_EQ(got[i], want[i]);
      });
    }
    ok(CeedElemRestrictionCreateVector(map.rstr, nullptr, nullptr));
  });
}

TEST_P(RestrictionConformance, LeavesWhatLiesBeyondItsVectors) {
  for_maps([&](const Map &map) {
    const Values l = random.reals(map.c.l_size + 3);
    const CeedSize size = map.e_size();
    const Values e = map.apply(CEED_NOTRANSPOSE, l, Values(static_cast<std::size_t>(size + 2), 8.0));
    for (CeedSize i = size; size > 0 && i < size + 2; i++) EXPECT_EQ(e[i], 8.0);
    const Values back = map.apply(CEED_TRANSPOSE, e, l);
    for (CeedSize i = map.c.l_size; i < map.c.l_size + 3; i++) EXPECT_EQ(back[i], l[i]);
  });
}

TEST_P(RestrictionConformance, TakesItsArraysAsAsked) {
  for_maps([&](const Map &map) {
    for (const CeedCopyMode mode : {CEED_USE_POINTER, CEED_OWN_POINTER}) {
      const Restriction other = make_restriction(ceed, map.c, mode);
      const Values l = random.reals(map.c.l_size), e = random.reals(map.e_size());
      const Vector l_vector = make_vector(ceed, l), e_vector = make_vector(ceed, map.e_size(), 0.0);
      ok(CeedElemRestrictionApply(other, CEED_NOTRANSPOSE, l_vector, e_vector, CEED_REQUEST_IMMEDIATE));
      EXPECT_EQ(values_of(e_vector), map.apply(CEED_NOTRANSPOSE, l, zeros(map.e_size())));
      set_values(e_vector, e);
      ok(CeedElemRestrictionApply(other, CEED_TRANSPOSE, e_vector, l_vector, CEED_REQUEST_IMMEDIATE));
      EXPECT_EQ(values_of(l_vector), map.apply(CEED_TRANSPOSE, e, l));
    }
  });
}

TEST_P(RestrictionConformance, StridesOfTheBackendAreAnyOneToOneMap) {
  for (int round = 0; round < 20; round++) {
    RestrictionCase c = random_restriction(random, CEED_RESTRICTION_STRIDED, round % 2 == 1);
    SCOPED_TRACE(describe(c));
    std::fill_n(c.strides, 3, 0);
    Map map(ceed, c);
    ok(CeedElemRestrictionGetLLayout(map.rstr, map.c.strides));
    expect_gathers(map, random);
    const Values l = random.reals(map.c.l_size);
    EXPECT_EQ(map.apply(CEED_TRANSPOSE, map.apply(CEED_NOTRANSPOSE, l, zeros(map.e_size())), zeros(map.c.l_size)), l);
  }
}

TEST_P(RestrictionConformance, BlockedIsPlainInAnotherOrder) {
  for_maps([&](const Map &map) {
    RestrictionCase c = map.c;
    c.block_size = 0;
    const Map plain(ceed, c);
    const Values l = random.reals(map.c.l_size), values = map.apply(CEED_NOTRANSPOSE, l, zeros(map.e_size()));
    const Values plain_values = plain.apply(CEED_NOTRANSPOSE, l, zeros(plain.e_size()));
    map.for_each_value([&](CeedInt e, CeedInt n, CeedInt comp) {
      EXPECT_EQ(values[e_place(map.rstr, e, n, comp)], plain_values[e_place(plain.rstr, e, n, comp)]);
    });
    EXPECT_EQ(map.apply(CEED_TRANSPOSE, values, l), plain.apply(CEED_TRANSPOSE, plain_values, l));

    // What fills the last block is the last element again.
    const CeedInt B = std::max(map.c.block_size, 1), num_block = (map.c.num_elem + B - 1) / B;
    for (CeedInt e = map.c.num_elem; e < num_block * B; e++) {
      for (CeedInt n = 0; n < map.c.elem_size; n++) {
        EXPECT_EQ(values[e_place(map.rstr, e, n, 0)], values[e_place(map.rstr, map.c.num_elem - 1, n, 0)]);
      }
    }
  });
}

TEST_P(RestrictionConformance, HasCopiesWithoutSignsAndWithoutOrientation) {
  for_maps([&](const Map &original) {
    struct Copy {
      int (*create)(CeedElemRestriction, CeedElemRestriction *);
      RestrictionCase c;
    };
    for (const Copy &copy : {Copy{CeedElemRestrictionCreateUnsignedCopy, without_signs(original.c)},
                             Copy{CeedElemRestrictionCreateUnorientedCopy, without_orientation(original.c)}}) {
      // The copy outlives the original, and is what the definition makes anew.
      Map map(ceed, original.c);
      Restriction rstr = std::move(map.rstr);
      ok(copy.create(rstr, map.rstr.out()));
      rstr.reset();
      map.c = copy.c;
      expect_gathers(map, random);
      const Values e_values = random.reals(map.e_size()), l = random.reals(map.c.l_size);
      expect_close(map.apply(CEED_TRANSPOSE, e_values, l), map.scattered(e_values, l), tolerance(4 * map.e_size()),
                   "l + R^T e", 1);
      const Map anew(ceed, copy.c);
      EXPECT_EQ(map.apply(CEED_TRANSPOSE, e_values, l), anew.apply(CEED_TRANSPOSE, e_values, l));
    }
  });
}

TEST_P(RestrictionConformance, ServesOneBlock) {
  for_maps([&](const Map &map) {
    CeedInt num_block = 0;
    ok(CeedElemRestrictionGetNumBlocks(map.rstr, &num_block));
    const CeedInt B = std::max(map.c.block_size, 1);
    EXPECT_EQ(num_block, (map.c.num_elem + B - 1) / B);
    const Values l = random.reals(map.c.l_size);
    for (CeedInt block = 0; block < num_block; block++) {
      const CeedInt num_nodes = map.c.num_nodes(block * B);
      const CeedSize size = CeedSize{num_nodes} * map.c.num_comp * B;
      const Values values = random.reals(size);
      Values gathered(static_cast<std::size_t>(size), 0.0), scattered = l;
      // Element fastest, then node, then component; the last element again where there are no more.
      for (CeedInt i = 0; i < size; i++) {
        const CeedInt e = block * B + i % B, n = i / B % num_nodes, comp = i / B / num_nodes;
        for (const auto &term : map.c.terms(std::min(e, map.c.num_elem - 1), n, comp)) {
          gathered[i] += term.coefficient * l[term.place];
          if (e < map.c.num_elem) scattered[term.place] += term.coefficient * values[i];
        }
      }
      gathered.push_back(-5.0);
      const Vector l_vector = make_vector(ceed, l), e_vector = make_vector(ceed, size + 1, -5.0);
      ok(CeedElemRestrictionApplyBlock(map.rstr, block, CEED_NOTRANSPOSE, l_vector, e_vector, CEED_REQUEST_IMMEDIATE));
      expect_close(values_of(e_vector), gathered, tolerance(3), "R_b l, and what lies beyond it", 6);
      const Vector exact = make_vector(ceed, values);
      ok(CeedElemRestrictionApplyBlock(map.rstr, block, CEED_TRANSPOSE, exact, l_vector, CEED_REQUEST_IMMEDIATE));
      expect_close(values_of(l_vector), scattered, tolerance(4 * size), "l + R_b^T values", 1);
    }
  });
}

TEST_P(RestrictionConformance, ServesThePointsOfOneElement) {
  for (int round = 0; round < 25; round++) {
    const Map map(ceed, random_restriction(random, CEED_RESTRICTION_POINTS, false));
    const Values l = random.reals(map.c.l_size);
    CeedInt longest = 0;
    ok(CeedElemRestrictionGetMaxPointsInElement(map.rstr, &longest));
    const CeedSize room = CeedSize{longest} * map.c.num_comp + 1;
    for (CeedInt e = 0; e < map.c.num_elem; e++) {
      Vector l_vector = make_vector(ceed, l), e_vector = make_vector(ceed, room, -5.0);
      const Values values = random.reals(room);
      Values gathered(static_cast<std::size_t>(room), -5.0), scattered = l;
      for (CeedInt comp = 0, i = 0; comp < map.c.num_comp; comp++) {
        for (CeedInt n = 0; n < map.c.num_nodes(e); n++, i++) {
          const CeedSize place = map.c.terms(e, n, comp)[0].place;
          gathered[i] = l[place];
          scattered[place] += values[i];
        }
      }
      ok(CeedElemRestrictionApplyAtPointsInElement(map.rstr, e, CEED_NOTRANSPOSE, l_vector, e_vector,
                                                   CEED_REQUEST_IMMEDIATE));
      EXPECT_EQ(values_of(e_vector), gathered) << "element " << e << ", or what lies beyond its points";
      set_values(e_vector, values);
      ok(CeedElemRestrictionApplyAtPointsInElement(map.rstr, e, CEED_TRANSPOSE, e_vector, l_vector,
                                                   CEED_REQUEST_IMMEDIATE));
      expect_close(values_of(l_vector), scattered, tolerance(2), "l + R_e^T values", 1);
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
