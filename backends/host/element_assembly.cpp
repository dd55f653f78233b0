#include "element_assembly.hpp"

#include "element_matrices.hpp"
#include "point_diagonal.hpp"

namespace hg::host {

std::unique_ptr<ElementAssembly> make_element_assembly(const Kernels &kernels, const CeedProgram &program,
                                                       CeedInt source, CeedInt sink, CeedAssembleKind kind) {
  auto made = PointDiagonal::make(kernels, program, source, sink, kind);
  return made ? std::move(made) : ElementMatrices::make(kernels, program, source, sink, kind);
}

}  // namespace hg::host
