#include "output/mesh_writer.hpp"

#include <petscdt.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "options/error.hpp"
#include "output/h5.hpp"
#include "swarm/hex_map.hpp"

namespace hg {
namespace {

constexpr const char *kHead = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\">\n<Collection>\n";
constexpr const char *kTail = "</Collection>\n</VTKFile>\n";
constexpr int kVtkHexahedron = 12;

static_assert(std::endian::native == std::endian::little || std::endian::native == std::endian::big);
constexpr const char *kByteOrder = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

std::string base64(const std::vector<unsigned char> &in) {
  static const char *digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((in.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < in.size(); i += 3) {
    const std::size_t n = std::min<std::size_t>(3, in.size() - i);
    unsigned v = 0;
    for (std::size_t k = 0; k < 3; k++) v = v << 8 | (k < n ? in[i + k] : 0u);
    for (std::size_t k = 0; k < 4; k++) out += k <= n ? digits[v >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

/// One VTK array: its length in bytes as an unsigned 64-bit number, then the values, all in base64.
template <class T>
std::string data_array(const char *type, const std::string &name, PetscInt components, std::span<const T> values) {
  std::vector<unsigned char> bytes(8 + values.size_bytes());
  const std::uint64_t length = values.size_bytes();
  std::memcpy(bytes.data(), &length, 8);
  if (length) std::memcpy(bytes.data() + 8, values.data(), length);
  return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" NumberOfComponents=\"" +
         std::to_string(components) + "\" format=\"binary\">\n" + base64(bytes) + "\n</DataArray>\n";
}

/// Places of the nodes: each cell's trilinear map at the Gauss-Lobatto points.
std::vector<double> node_places(const MeshView &mesh) {
  const PetscInt n = mesh.order + 1, per_cell = n * n * n;
  std::vector<PetscReal> t(n), w(n);
  petsc_check(
      PetscDTGaussLobattoLegendreQuadrature(n, PETSCGAUSSLOBATTOLEGENDRE_VIA_LINEAR_ALGEBRA, t.data(), w.data()));
  std::vector<double> x(3 * static_cast<std::size_t>(mesh.num_nodes), 0.0);
  for (std::size_t c = 0; c < mesh.corners.size() / 24; c++) {
    const HexMap map = HexMap::from_corners(std::span<const double, 24>(&mesh.corners[24 * c], 24));
    for (PetscInt i = 0; i < per_cell; i++) {
      const double xi[3] = {t[i % n], t[i / n % n], t[i / n / n]};
      map.position(xi, &x[mesh.cell_nodes[c * per_cell + i]]);
    }
  }
  return x;
}

std::string piece(const MeshView &mesh, std::span<const NodeField> nodes, std::span<const CellField> cells) {
  const PetscInt p = mesh.order, n = p + 1, sub = p * p * p;
  const std::size_t num_cells = mesh.corners.size() / 24, num_sub = num_cells * sub;
  std::vector<std::int64_t> connectivity, offsets(num_sub);
  connectivity.reserve(8 * num_sub);
  for (std::size_t c = 0; c < num_cells; c++) {
    const CeedInt *node = &mesh.cell_nodes[c * n * n * n];
    for (PetscInt s = 0; s < sub; s++) {
      const PetscInt i = s % p, j = s / p % p, k = s / p / p;
      // VTK goes around the low face, then around the high one.
      constexpr int kAround[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                     {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
      for (const auto &d : kAround) connectivity.push_back(node[(i + d[0]) + n * ((j + d[1]) + n * (k + d[2]))] / 3);
    }
  }
  for (std::size_t s = 0; s < num_sub; s++) offsets[s] = static_cast<std::int64_t>(8 * (s + 1));
  const std::vector<std::uint8_t> types(num_sub, kVtkHexahedron);

  std::string text = "<Piece NumberOfPoints=\"" + std::to_string(mesh.num_nodes) + "\" NumberOfCells=\"" +
                     std::to_string(num_sub) + "\">\n<Points>\n";
  text += data_array<double>("Float64", "Points", 3, node_places(mesh));
  text += "</Points>\n<Cells>\n";
  text += data_array<std::int64_t>("Int64", "connectivity", 1, connectivity);
  text += data_array<std::int64_t>("Int64", "offsets", 1, offsets);
  text += data_array<std::uint8_t>("UInt8", "types", 1, types);
  text += "</Cells>\n<PointData>\n";
  for (const NodeField &f : nodes) text += data_array<double>("Float64", f.name, f.components, f.values);
  text += "</PointData>\n<CellData>\n";
  for (const CellField &f : cells) {
    std::vector<double> each;  // one value for each sub-cell
    each.reserve(num_sub);
    for (const double v : f.values) each.insert(each.end(), sub, v);
    text += data_array<double>("Float64", f.name, 1, each);
  }
  return text + "</CellData>\n</Piece>\n";
}

std::string vtk_head(const char *type) {
  return std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"") + type + "\" version=\"1.0\" byte_order=\"" +
         kByteOrder + "\" header_type=\"UInt64\">\n";
}

/// The file that names the pieces of all ranks.
std::string pieces(const std::string &prefix, PetscInt step, int size, std::span<const NodeField> nodes,
                   std::span<const CellField> cells) {
  std::string text =
      vtk_head("PUnstructuredGrid") + "<PUnstructuredGrid GhostLevel=\"0\">\n<PPoints>\n" +
      "<PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n</PPoints>\n<PPointData>\n";
  for (const NodeField &f : nodes) {
    text += "<PDataArray type=\"Float64\" Name=\"" + f.name + "\" NumberOfComponents=\"" +
            std::to_string(f.components) + "\"/>\n";
  }
  text += "</PPointData>\n<PCellData>\n";
  for (const CellField &f : cells) {
    text += "<PDataArray type=\"Float64\" Name=\"" + f.name + "\" NumberOfComponents=\"1\"/>\n";
  }
  text += "</PCellData>\n";
  for (int r = 0; r < size; r++) {
    char extension[32];
    std::snprintf(extension, sizeof extension, "-%04d.vtu", r);
    text += "<Piece Source=\"" + file_name(numbered(prefix, step, extension)) + "\"/>\n";
  }
  return text + "</PUnstructuredGrid>\n</VTKFile>\n";
}

std::string check(const MeshView &mesh, std::span<const NodeField> nodes, std::span<const CellField> cells) {
  const PetscInt n = mesh.order + 1;
  const std::size_t num_cells = mesh.corners.size() / 24;
  if (mesh.cell_nodes.size() != num_cells * static_cast<std::size_t>(n * n * n)) {
    return "mesh output: " + std::to_string(mesh.cell_nodes.size()) + " cell nodes for " + std::to_string(num_cells) +
           " cells of order " + std::to_string(mesh.order);
  }
  for (const NodeField &f : nodes) {
    if (f.values.size() != static_cast<std::size_t>(mesh.num_nodes * f.components)) {
      return "mesh output: field '" + f.name + "' has " + std::to_string(f.values.size()) + " values for " +
             std::to_string(mesh.num_nodes) + " nodes and " + std::to_string(f.components) + " components";
    }
  }
  for (const CellField &f : cells) {
    if (f.values.size() != num_cells) {
      return "mesh output: field '" + f.name + "' has " + std::to_string(f.values.size()) + " values for " +
             std::to_string(num_cells) + " cells";
    }
  }
  return "";
}

}  // namespace

MeshWriter::MeshWriter(MPI_Comm comm, std::string prefix)
    : comm_(comm), prefix_(std::move(prefix)), series_(comm, prefix_ + ".pvd", kHead, kTail) {}

void MeshWriter::resume(PetscInt last_step) {
  series_.resume(last_step);
}

void MeshWriter::write(PetscInt step, PetscReal time, const MeshView &mesh, std::span<const NodeField> nodes,
                       std::span<const CellField> cells) {
  int rank, size;
  MPI_Comm_rank(comm_, &rank);
  MPI_Comm_size(comm_, &size);
  throw_together(comm_, check(mesh, nodes, cells));
  std::string path = numbered(prefix_, step, size == 1 ? ".vtu" : ".pvtu");
  std::string mine = path;
  if (size > 1) {
    char extension[32];
    std::snprintf(extension, sizeof extension, "-%04d.vtu", rank);
    mine = numbered(prefix_, step, extension);
  }
  std::string error;
  try {
    write_text(MPI_COMM_SELF, mine,
               vtk_head("UnstructuredGrid") + "<UnstructuredGrid>\n" + piece(mesh, nodes, cells) +
                   "</UnstructuredGrid>\n</VTKFile>\n");
  } catch (const Error &e) {
    error = e.what();
  }
  throw_together(comm_, error);
  if (size > 1) write_text(comm_, path, pieces(prefix_, step, size, nodes, cells));
  char head[64];
  std::snprintf(head, sizeof head, "<DataSet timestep=\"%.17g\" part=\"0\" file=\"", time);
  series_.add(step, head + file_name(path) + "\"/>\n");
}

}  // namespace hg
