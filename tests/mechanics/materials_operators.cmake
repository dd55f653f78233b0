# Tests of the rooms materials and operators.
hg_mechanics_test(materials_elasticity_test)
hg_mechanics_test(materials_qfunctions_test)
target_sources(materials_qfunctions_test PRIVATE qfunctions_as_c.c)
hg_mechanics_test(operators_solid_test RANKS 1 2 3)
hg_mechanics_test(operators_projection_test RANKS 1 2 3)
