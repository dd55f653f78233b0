// Bases as they are defined, a value for each thread, without any reuse between threads.

namespace hg::gpu {

/// T_(g,d)(q, n) of a point, as BasisJob says.
struct Factor {
  const CeedScalar *row;
  HG_DEVICE CeedScalar operator()(CeedInt n) const { return row == nullptr ? 1 : row[n]; }
  HG_DEVICE Factor(const BasisJob &job, CeedInt g, CeedInt d, CeedSize point, CeedInt q) {
    const bool is_derivative = job.is_derivative && d == g;
    if (d >= job.num_directions) {
      row = nullptr;
    } else if (job.table != nullptr) {
      row = job.table + ((point * job.num_directions + d) * 2 + (is_derivative ? 1 : 0)) * job.P;
    } else if (!job.is_tensor) {
      row = job.interp + (static_cast<CeedSize>(g) * job.Q + q) * job.P;
    } else {
      for (CeedInt k = 0; k < d; k++) q /= job.Q;
      row = (is_derivative ? job.derivative : job.interp) + q % job.Q * job.P;
    }
  }
};

HG_KERNEL(hg_evaluate, BasisJob) {
  const CeedInt values = job.num_values * job.num_comp;
  const CeedSize point = index() / values;
  if (point >= job.points.num_points) return;
  const CeedInt i = static_cast<CeedInt>(index() % values), g = i / job.num_comp, c = i % job.num_comp;
  const PointOfElement at(job.points, point);
  const Factor x(job, g, 0, point, at.q), y(job, g, 1, point, at.q), z(job, g, 2, point, at.q);
  const CeedInt P_y = job.num_directions > 1 ? job.P : 1, P_z = job.num_directions > 2 ? job.P : 1;
  const CeedScalar *u = job.u + (static_cast<CeedSize>(at.elem) * job.num_comp + c) * job.num_nodes;
  CeedScalar sum = 0;
  for (CeedInt n_z = 0; n_z < P_z; n_z++) {
    CeedScalar in_plane = 0;
    for (CeedInt n_y = 0; n_y < P_y; n_y++) {
      CeedScalar in_line = 0;
      for (CeedInt n_x = 0; n_x < job.P; n_x++) in_line += x(n_x) * u[(n_z * P_y + n_y) * job.P + n_x];
      in_plane += y(n_y) * in_line;
    }
    sum += z(n_z) * in_plane;
  }
  job.v[at.place(values, i)] = sum;
}

/// A node for each thread, which sums the points of its element in their order.
HG_KERNEL(hg_integrate, BasisJob) {
  const CeedInt of_element = job.num_comp * job.num_nodes;
  const CeedInt elem = static_cast<CeedInt>(index() / of_element);
  if (elem >= job.num_elem) return;
  const CeedInt c = static_cast<CeedInt>(index() % of_element) / job.num_nodes;
  const CeedInt n = static_cast<CeedInt>(index() % job.num_nodes), values = job.num_values * job.num_comp;
  const CeedInt n_x = n % job.P, n_y = n / job.P % job.P, n_z = n / job.P / job.P;
  const bool is_ragged = job.points.starts != nullptr;
  const CeedSize first = is_ragged ? job.points.starts[elem] : static_cast<CeedSize>(elem) * job.points.num_qpts;
  const CeedSize end = is_ragged ? job.points.starts[elem + 1] : first + job.points.num_qpts;
  CeedScalar sum = 0;
  for (CeedSize point = first; point < end; point++) {
    const PointOfElement at(job.points, point);
    for (CeedInt g = 0; g < job.num_values; g++) {
      const Factor x(job, g, 0, point, at.q), y(job, g, 1, point, at.q), z(job, g, 2, point, at.q);
      sum += x(n_x) * y(n_y) * z(n_z) * job.u[at.place(values, g * job.num_comp + c)];
    }
  }
  CeedScalar &v = job.v[index()];
  v = job.add ? v + sum : sum;
}

/// `interp` are the weights.
HG_KERNEL(hg_weight, BasisJob) {
  if (index() < job.points.num_points) job.v[index()] = job.interp[index() % job.points.num_qpts];
}

/// T_(k+1) = 2 x T_k - T_(k-1), a coordinate for each thread.
HG_KERNEL(hg_point_table, PointTableJob) {
  const CeedSize point = index() / job.dim;
  if (point >= job.points.num_points) return;
  const PointOfElement at(job.points, point);
  const CeedInt d = static_cast<CeedInt>(index() % job.dim);
  const CeedScalar x = job.x_ref[at.place(job.dim, d)];
  CeedScalar *value = job.table + index() * 2 * job.P, *derivative = value + job.P;
  for (CeedInt n = 0; n < job.P; n++) value[n] = derivative[n] = 0;
  CeedScalar t = 1, dt = 0, t_last = 0, dt_last = 0;
  for (CeedInt k = 0; k < job.num_coefficients; k++) {
    for (CeedInt n = 0; n < job.P; n++) {
      value[n] += job.coefficients[k * job.P + n] * t;
      derivative[n] += job.coefficients[k * job.P + n] * dt;
    }
    const CeedScalar two = k == 0 ? 1 : 2;  // T_1 = x T_0
    const CeedScalar t_next = two * x * t - t_last, dt_next = two * (t + x * dt) - dt_last;
    t_last = t;
    t = t_next;
    dt_last = dt;
    dt = dt_next;
  }
}

}  // namespace hg::gpu
