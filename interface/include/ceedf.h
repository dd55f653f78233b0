! For programs that include the older name.
      include 'ceed/fortran.h'
