#include "output/points_writer.hpp"

#include <cstdio>
#include <numeric>
#include <vector>

#include "options/error.hpp"
#include "output/h5.hpp"

namespace hg {
namespace {

constexpr const char *kHead =
    "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"3.0\">\n<Domain>\n"
    "<Grid Name=\"points over time\" GridType=\"Collection\" CollectionType=\"Temporal\">\n";
constexpr const char *kTail = "</Grid>\n</Domain>\n</Xdmf>\n";

/// Collects datasets in the file and what the XDMF says of them.
class PointFile {
 public:
  PointFile(H5File &file, std::string name, const H5Rows &rows) : file_(file), name_(std::move(name)), rows_(rows) {}

  void reals(const std::string &dataset, std::span<const double> values, hsize_t components) {
    file_.write(dataset, H5T_NATIVE_DOUBLE, values.data(), rows_, components == 1 ? 0 : components);
    attribute(dataset, components, "Float", 8);
  }
  template <class T>
  void integers(const std::string &dataset, std::span<const T> values) {
    file_.write(dataset, sizeof(T) == 8 ? H5T_NATIVE_INT64 : H5T_NATIVE_INT32, values.data(), rows_, 0);
    attribute(dataset, 1, "Int", sizeof(T));
  }
  /// The places of the points: geometry, not an attribute.
  void places(std::span<const double> x) {
    file_.write("x", H5T_NATIVE_DOUBLE, x.data(), rows_, 3);
    // One cell for each point: without a list of them ParaView has points but nothing to draw or to filter.
    std::vector<std::int64_t> vertex(rows_.local);
    std::iota(vertex.begin(), vertex.end(), static_cast<std::int64_t>(rows_.first));
    file_.write("vertex", H5T_NATIVE_INT64, vertex.data(), rows_, 0);
    geometry_ = "  <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"" + std::to_string(rows_.total) +
                "\" NodesPerElement=\"1\">\n" + item("vertex", 1, "Int", 8) + "  </Topology>\n" +
                "  <Geometry GeometryType=\"XYZ\">\n" + item("x", 3, "Float", 8) + "  </Geometry>\n";
  }
  std::string text() const { return geometry_ + attributes_; }

 private:
  std::string item(const std::string &dataset, hsize_t components, const char *type, int precision) const {
    std::string dims = std::to_string(rows_.total);
    if (components > 1) dims.append(" ").append(std::to_string(components));
    return "    <DataItem Dimensions=\"" + dims + "\" NumberType=\"" + type + "\" Precision=\"" +
           std::to_string(precision) + "\" Format=\"HDF\">" + name_ + ":/" + dataset + "</DataItem>\n";
  }
  void attribute(const std::string &dataset, hsize_t components, const char *type, int precision) {
    const char *kind = components == 1 ? "Scalar" : (components == 3 ? "Vector" : "Tensor");
    attributes_ += "  <Attribute Name=\"" + dataset + "\" AttributeType=\"" + kind + "\" Center=\"Node\">\n" +
                   item(dataset, components, type, precision) + "  </Attribute>\n";
  }

  H5File &file_;
  std::string name_;
  H5Rows rows_;
  std::string geometry_, attributes_;
};

std::vector<double> determinants(std::span<const double> F) {
  std::vector<double> J(F.size() / 9);
  for (std::size_t p = 0; p < J.size(); p++) {
    const double *A = &F[9 * p];
    J[p] = A[0] * (A[4] * A[8] - A[5] * A[7]) - A[1] * (A[3] * A[8] - A[5] * A[6]) + A[2] * (A[3] * A[7] - A[4] * A[6]);
  }
  return J;
}

/// xx yy zz yz xz xy as nine, row-major.
std::vector<double> full_tensor(std::span<const double> s) {
  constexpr int kFrom[9] = {0, 5, 4, 5, 1, 3, 4, 3, 2};
  std::vector<double> t(s.size() / 6 * 9);
  for (std::size_t p = 0; p < s.size() / 6; p++) {
    for (int i = 0; i < 9; i++) t[9 * p + i] = s[6 * p + kFrom[i]];
  }
  return t;
}

}  // namespace

PointsWriter::PointsWriter(MPI_Comm comm, std::string prefix)
    : comm_(comm), prefix_(std::move(prefix)), series_(comm, prefix_ + ".xdmf", kHead, kTail) {}

void PointsWriter::resume(PetscInt last_step) {
  series_.resume(last_step);
}

void PointsWriter::write(PetscInt step, PetscReal time, const Swarm &swarm, std::span<const ExtraPointField> extra) {
  const NoFileSizeSignal quiet;
  const auto n = static_cast<std::size_t>(swarm.local_size());
  std::string error;
  for (const ExtraPointField &f : extra) {
    const bool known = f.components == 1 || f.components == 3 || f.components == 6 || f.components == 9;
    if (!known || f.values.size() != n * static_cast<std::size_t>(f.components)) {
      error = "points output: field '" + f.name + "' has " + std::to_string(f.values.size()) + " values for " +
              std::to_string(n) + " points and " + std::to_string(f.components) + " components";
    }
  }
  throw_together(comm_, error);

  const std::string path = numbered(prefix_, step, ".h5"), temporary = path + ".tmp";
  std::string text;
  try {
    std::uint64_t bytes = (3 + 3 + 3 + 1 + 1) * sizeof(double) + sizeof(std::int32_t) + 2 * sizeof(std::int64_t);
    for (const ExtraPointField &f : extra) bytes += (f.components == 6 ? 9 : f.components) * sizeof(double);
    std::string full = reserve(comm_, temporary, n * bytes);
    if (!full.empty()) full = "cannot write " + path + ": " + full;
    throw_together(comm_, full);
    H5File file(comm_, temporary, H5File::Mode::kCreate);
    PointFile points(file, file_name(path), H5Rows::of(comm_, n));
    if (file.good()) {
      points.places(PointField<double>(swarm, field::x).span());
      points.reals("displacement", PointField<double>(swarm, field::u).span(), 3);
      points.reals("velocity", PointField<double>(swarm, field::v).span(), 3);
      points.reals("volume", PointField<double>(swarm, field::V).span(), 1);
      points.reals("J", determinants(PointField<double>(swarm, field::F).span()), 1);
      points.integers<std::int32_t>("region", PointField<std::int32_t>(swarm, field::region).span());
      points.integers<std::int64_t>("id", PointField<std::int64_t>(swarm, field::id).span());
      for (const ExtraPointField &f : extra) {
        const bool symmetric = f.components == 6;
        const std::vector<double> nine = symmetric ? full_tensor(f.values) : std::vector<double>();
        points.reals(f.name, symmetric ? nine : f.values, symmetric ? 9 : static_cast<hsize_t>(f.components));
      }
      file.write_attribute("/", "time", time);
      file.write_attribute("/", "step", static_cast<std::int64_t>(step));
    }
    file.finish("write");
    throw_together(comm_, sync_and_rename(comm_, temporary, path));
    text = points.text();
  } catch (const Error &) {
    int rank;
    MPI_Comm_rank(comm_, &rank);
    if (rank == 0) std::remove(temporary.c_str());
    throw;
  }
  char head[128];
  std::snprintf(head, sizeof head, "<Grid Name=\"points\" GridType=\"Uniform\">\n  <Time Value=\"%.17g\"/>\n", time);
  series_.add(step, head + text + "</Grid>\n");
}

}  // namespace hg
