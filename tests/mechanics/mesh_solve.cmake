# Mesh, options, boundary conditions, solver
hg_mechanics_test(mesh_spaces_test RANKS 1 2 3)
hg_mechanics_test(options_group_test)
hg_mechanics_test(solve_clock_test)
hg_mechanics_test(boundary_conditions_test RANKS 1 2 3)
hg_mechanics_test(static_solver_test RANKS 1 2 3)
