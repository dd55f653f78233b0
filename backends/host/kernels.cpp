/// The table of kernels of one instruction set; compiled once for each.
#include "kernels.hpp"

#include "block_copy.hpp"
#include "contract.hpp"
#include "points.hpp"

#define HG_TEXT(name) #name
#define HG_NAME(name) HG_TEXT(name)

namespace hg::host::HG_HOST_ISA {

extern const Kernels table;
const Kernels table{
    .isa = HG_NAME(HG_HOST_ISA),
    .width = W,
    .contraction = contraction,
    .point_evaluation = point_evaluation,
    .point_integration = point_integration,
    .gather_points = gather_points,
    .scatter_add_points = scatter_add_points,
    .gather = gather,
    .ask_for_nodes = ask_for_nodes,
    .scatter_add = scatter_add,
    .gather_rows = gather_rows,
    .to_rows = to_rows,
};

}  // namespace hg::host::HG_HOST_ISA
