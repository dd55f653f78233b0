// A QFunction, a point for each thread. Before this come its own text, and
//   HG_QFUNCTION        its name
//   HG_NUM_INPUTS, HG_NUM_OUTPUTS
//   HG_INPUT_SIZES, HG_OUTPUT_SIZES   values at a point, in braces; {1} where there are none
//   HG_VECTOR_LENGTH    points that it is called for

namespace hg::gpu {

constexpr int vector_length = HG_VECTOR_LENGTH;
constexpr int input_sizes[] = HG_INPUT_SIZES, output_sizes[] = HG_OUTPUT_SIZES;

template <int n>
HG_DEVICE constexpr int total(const int (&sizes)[n]) {
  int sum = 0;
  for (int i = 0; i < n; i++) sum += sizes[i];
  return sum;
}

HG_KERNEL(hg_qfunction, QFunctionJob) {
  const CeedSize first = index() * vector_length;
  if (first >= job.points.num_points) return;
  CeedScalar in[total(input_sizes) * vector_length], out[total(output_sizes) * vector_length];
  const CeedScalar *inputs[HG_NUM_INPUTS + 1];
  CeedScalar *outputs[HG_NUM_OUTPUTS + 1];
  // The last point fills up what is left of the last call.
  const auto point = [&](int lane) {
    return first + lane < job.points.num_points ? first + lane : job.points.num_points - 1;
  };
  for (int i = 0, at = 0; i < HG_NUM_INPUTS; at += input_sizes[i] * vector_length, i++) {
    inputs[i] = in + at;
    for (int lane = 0; lane < vector_length; lane++) {
      const PointOfElement of(job.points, point(lane));
      for (int c = 0; c < input_sizes[i]; c++) {
        in[at + c * vector_length + lane] = job.inputs[i][of.place(input_sizes[i], c)];
      }
    }
  }
  for (int i = 0, at = 0; i < HG_NUM_OUTPUTS; at += output_sizes[i] * vector_length, i++) outputs[i] = out + at;
  const int code = HG_QFUNCTION(job.context, vector_length, inputs, outputs);
  if (code != 0 && job.failed != nullptr) *job.failed = code;
  for (int i = 0; i < HG_NUM_OUTPUTS; i++) {
    for (int lane = 0; lane < vector_length && first + lane < job.points.num_points; lane++) {
      const PointOfElement of(job.points, first + lane);
      for (int c = 0; c < output_sizes[i]; c++) {
        job.outputs[i][of.place(output_sizes[i], c)] = outputs[i][c * vector_length + lane];
      }
    }
  }
}

}  // namespace hg::gpu
