// Arithmetic of vectors, one entry for each thread.

namespace hg::gpu {

HG_KERNEL(hg_set_value, VectorJob) {
  const CeedSize i = index();
  if (i < job.length) job.w[job.start + i * job.step] = job.a;
}

HG_KERNEL(hg_copy, VectorJob) {
  const CeedSize i = job.start + index() * job.step;
  if (index() < job.length) job.w[i] = job.x[i];
}

/// w = a x + b w, without reading w where b is 0.
HG_KERNEL(hg_axpby, VectorJob) {
  const CeedSize i = index();
  if (i < job.length) job.w[i] = job.b == 0 ? job.a * job.x[i] : job.a * job.x[i] + job.b * job.w[i];
}

HG_KERNEL(hg_scale, VectorJob) {
  const CeedSize i = index();
  if (i < job.length) job.w[i] *= job.a;
}

HG_KERNEL(hg_pointwise_mult, VectorJob) {
  const CeedSize i = index();
  if (i < job.length) job.w[i] = job.x[i] * job.y[i];
}

/// Entries no larger than a stay as they are.
HG_KERNEL(hg_reciprocal, VectorJob) {
  const CeedSize i = index();
  if (i < job.length && fabs(job.w[i]) > job.a) job.w[i] = 1 / job.w[i];
}

HG_KERNEL(hg_filter, VectorJob) {
  const CeedSize i = index();
  if (i < job.length && fabs(job.w[i]) <= job.a) job.w[i] = 0;
}

/// |x|_1, |x|_2^2 or |x|_max of a block's part; a NaN is larger than all numbers. The same order each time.
HG_KERNEL(hg_norm, NormJob) {
  HG_SHARED(sums);
  CeedScalar sum = 0;
  for (CeedSize i = index(); i < job.length; i += static_cast<CeedSize>(num_blocks()) * num_threads()) {
    const CeedScalar x = job.x[i];
    sum = job.type == CEED_NORM_1 ? sum + fabs(x) : job.type == CEED_NORM_2 ? sum + x * x : larger(sum, fabs(x));
  }
  sums[thread()] = sum;
  for (int half = num_threads() / 2; half > 0; half /= 2) {
    barrier();
    if (thread() >= half) continue;
    const CeedScalar a = sums[thread()], b = sums[thread() + half];
    sums[thread()] = job.type == CEED_NORM_MAX ? larger(a, b) : a + b;
  }
  if (thread() == 0) job.norms[block()] = sums[0];
}

}  // namespace hg::gpu
