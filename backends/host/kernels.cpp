/// The table of kernels of one instruction set; compiled once for each.
#include "kernels.hpp"

#include "block_copy.hpp"
#include "contract.hpp"
#include "contract_element.hpp"
#include "point_products.hpp"
#include "points.hpp"

#define HG_TEXT(name) #name
#define HG_NAME(name) HG_TEXT(name)

namespace hg::host::HG_HOST_ISA {

extern const Kernels table, element_table;
const Kernels table{
    .isa = HG_NAME(HG_HOST_ISA),
    .width = W,
    .columns = 0,
    .contraction = contraction,
    .point_evaluation = point_evaluation<W>,
    .point_integration = point_integration<W>,
    .point_moments = moments,
    .square_integration = square_integration,
    .gather_points = gather_points,
    .scatter_points = {scatter_points<false>, scatter_points<true>},
    .gather = gather,
    .ask_for_nodes = ask_for_nodes<W>,
    .scatter_add = scatter_add,
    .gather_rows = gather_rows,
    .to_rows = to_rows,
    .to_entries = to_entries,
};
const Kernels element_table{
    .isa = HG_NAME(HG_HOST_ISA),
    .width = 1,
    .columns = W,
    .contraction = element_contraction,
    .point_evaluation = point_evaluation<1>,
    .point_integration = point_integration<1>,
    .point_moments = moments,
    .square_integration = square_integration,
    .gather_points = gather_points,
    .scatter_points = {scatter_points<false>, scatter_points<true>},
    .gather = gather_element,
    .ask_for_nodes = ask_for_nodes<1>,
    .scatter_add = scatter_add,
    .gather_rows = copy_row,
    .to_rows = copy_element,
    .to_entries = copy_entries,
};

}  // namespace hg::host::HG_HOST_ISA
