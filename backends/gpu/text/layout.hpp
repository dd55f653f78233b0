// Between the layout of fields here, element by element, and that of kernels of the user's, component by component.

namespace hg::gpu {

/// A point for each thread.
HG_KERNEL(hg_layout, LayoutJob) {
  const CeedSize i = index();
  if (i >= job.count) return;
  const PointOfElement point(job.points, job.first + i);
  for (CeedInt c = 0; c < job.size; c++) {
    const CeedSize here = point.place(job.size, c), there = c * job.count + i;
    if (job.is_to_user) {
      job.to[there] = job.from[here];
    } else {
      job.to[here] = job.from[there];
    }
  }
}

}  // namespace hg::gpu
