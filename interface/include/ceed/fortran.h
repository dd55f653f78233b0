! Constants of the interface for Fortran:      include 'ceed/fortran.h'
!
! Every procedure has the name and the arguments of the C function, by reference, and an integer error code after them.
! Objects are integers. Arrays that come out are an integer*8 offset: entry i is a(i + offset) for the array a that was passed.
! A QFunction is a subroutine f(ctx, q, u1, ..., u16, v1, ..., v16, err).

      integer ceed_mem_host, ceed_mem_device
      parameter(ceed_mem_host = 0, ceed_mem_device = 1)

      integer ceed_scalar_fp32, ceed_scalar_fp64
      parameter(ceed_scalar_fp32 = 0, ceed_scalar_fp64 = 1)

      integer ceed_copy_values, ceed_use_pointer, ceed_own_pointer
      parameter(ceed_copy_values = 0, ceed_use_pointer = 1)
      parameter(ceed_own_pointer = 2)

      integer ceed_norm_1, ceed_norm_2, ceed_norm_max
      parameter(ceed_norm_1 = 0, ceed_norm_2 = 1, ceed_norm_max = 2)

      integer ceed_notranspose, ceed_transpose
      parameter(ceed_notranspose = 0, ceed_transpose = 1)

      integer ceed_eval_none, ceed_eval_interp, ceed_eval_grad
      integer ceed_eval_div, ceed_eval_curl, ceed_eval_weight
      parameter(ceed_eval_none = 0, ceed_eval_interp = 1)
      parameter(ceed_eval_grad = 2, ceed_eval_div = 4)
      parameter(ceed_eval_curl = 8, ceed_eval_weight = 16)

      integer ceed_gauss, ceed_gauss_lobatto
      parameter(ceed_gauss = 0, ceed_gauss_lobatto = 1)

! Topologies; libCEED's spelling of the pyramid, too
      integer ceed_line, ceed_triangle, ceed_quad, ceed_tet
      integer ceed_pyramid, ceed_pryamid, ceed_prism, ceed_hex
      parameter(ceed_line = 65536, ceed_triangle = 131073)
      parameter(ceed_quad = 131074, ceed_tet = 196611)
      parameter(ceed_pyramid = 196612, ceed_pryamid = 196612)
      parameter(ceed_prism = 196613, ceed_hex = 196614)

! In the place of objects
      integer ceed_request_immediate, ceed_request_ordered
      parameter(ceed_request_immediate = -1, ceed_request_ordered = -2)

      integer ceed_null, ceed_strides_backend
      parameter(ceed_null = -3, ceed_strides_backend = -4)

      integer ceed_vector_active, ceed_vector_none
      parameter(ceed_vector_active = -5, ceed_vector_none = -6)

      integer ceed_elemrestriction_none, ceed_basis_none
      parameter(ceed_elemrestriction_none = -7, ceed_basis_none = -8)

      integer ceed_qfunction_none
      parameter(ceed_qfunction_none = -9)
