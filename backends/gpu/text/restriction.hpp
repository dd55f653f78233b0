// From the L-vector to an E-vector, and back.

namespace hg::gpu {

/// v = T G u, a node for each thread.
HG_KERNEL(hg_gather, RestrictionJob) {
  const CeedSize i = index();
  if (i >= job.num_nodes) return;
  for (CeedInt c = 0; c < job.num_comp; c++) {
    const CeedSize shift = static_cast<CeedSize>(c) * job.comp_stride;
    CeedScalar value = 0;
    if (job.num_bands == 0) {
      value = job.u[job.place[i] + shift];
    } else {
      const CeedInt n = static_cast<CeedInt>(i % job.elem_size);
      for (CeedInt k = 0; k < job.num_bands; k++) {
        const CeedInt to_other = k - job.num_bands / 2;
        if (n + to_other < 0 || n + to_other >= job.elem_size) continue;
        value += job.bands[i * job.num_bands + k] * job.u[job.place[i + to_other] + shift];
      }
    }
    job.v[job.entry[i] + static_cast<CeedSize>(c) * job.step[i]] = value;
  }
}

/// v += (T G)^T u for one component, an entry of the L-vector for each thread, which sums its nodes in their order.
HG_KERNEL(hg_scatter_add, RestrictionJob) {
  const CeedSize r = index();
  if (r >= job.num_rows) return;
  const auto value = [&](CeedSize i) { return job.u[job.entry[i] + static_cast<CeedSize>(job.comp) * job.step[i]]; };
  CeedScalar sum = 0;
  for (CeedSize j = job.rows[r]; j < job.rows[r + 1]; j++) {
    const CeedSize i = job.nodes[j];
    if (job.num_bands == 0) {
      sum += value(i);
    } else {
      const CeedInt n = static_cast<CeedInt>(i % job.elem_size);
      for (CeedInt k = 0; k < job.num_bands; k++) {
        const CeedInt from_other = job.num_bands / 2 - k;
        if (n + from_other < 0 || n + from_other >= job.elem_size) continue;
        sum += job.bands[(i + from_other) * job.num_bands + k] * value(i + from_other);
      }
    }
  }
  job.v[job.place[job.nodes[job.rows[r]]] + static_cast<CeedSize>(job.comp) * job.comp_stride] += sum;
}

}  // namespace hg::gpu
