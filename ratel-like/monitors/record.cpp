#include "monitors/record.hpp"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string_view>

#include "options/error.hpp"
#include "options/options.hpp"

namespace hg {

namespace {

void add(std::string &line, double value) {
  char text[40];
  std::snprintf(text, sizeof(text), ",%.12g", value);
  line += text;
}

void add(std::string &line, const std::array<double, 3> &value) {
  for (double component : value) add(line, component);
}

void add_names(std::string &line, const std::string &stem) {
  for (const char *axis : {"_x", "_y", "_z"}) line.append(",").append(stem).append(axis);
}

}  // namespace

Monitors::Monitors(MPI_Comm comm, RecordNames names) : comm_(comm), names_(std::move(names)) {
  MPI_Comm_rank(comm, &rank_);
  OptionGroup group(comm, "", "Monitors");
  const auto read = [&](const char *name, const char *help, bool everything) {
    Table table{.option = group.full(name),
                .file = group.string(name, help, ""),
                .on = group.given(name),
                .everything = everything};
    if (std::string_view(table.file).starts_with("ascii:")) table.file.erase(0, 6);
    if (table.on) tables_.push_back(table);
  };
  read("ts_monitor_quantities", "CSV file of all quantities after each step; without a name: to the screen", true);
  read("ts_monitor_strain_energy", "CSV file of strain energies after each step; without a name: to the screen", false);
}

std::string Monitors::header(const Table &table) const {
  std::string line = "step,time";
  if (!table.everything) {
    for (const auto &region : names_.regions) line.append(",strain_energy_").append(region);
    return line += ",strain_energy\n";
  }
  line += ",dt,newton_iterations,linear_iterations,mass,strain_energy";
  add_names(line, "momentum");
  for (const auto &probe : names_.probes) add_names(line, "displacement_" + probe);
  for (const auto &region : names_.regions) {
    line.append(",mass_").append(region).append(",volume_").append(region).append(",strain_energy_").append(region);
    add_names(line, "mean_displacement_" + region);
    add_names(line, "body_force_" + region);
  }
  for (const auto &face : names_.reactions) add_names(line, "reaction_" + face);
  return line += '\n';
}

std::string Monitors::line(const Table &table, const Record &record) const {
  std::string line = std::to_string(record.step);
  add(line, record.time);
  double energy = 0, mass = 0;
  for (const auto &region : record.regions) {
    energy += region.strain_energy;
    mass += region.mass;
  }
  if (!table.everything) {
    for (const auto &region : record.regions) add(line, region.strain_energy);
    add(line, energy);
    return line += '\n';
  }
  add(line, record.dt);
  add(line, static_cast<double>(record.newton_iterations));
  add(line, static_cast<double>(record.linear_iterations));
  add(line, mass);
  add(line, energy);
  add(line, record.momentum);
  for (const auto &probe : record.probes) add(line, probe);
  for (const auto &region : record.regions) {
    add(line, region.mass);
    add(line, region.volume);
    add(line, region.strain_energy);
    add(line, region.mean_displacement);
    add(line, region.body_force);
  }
  for (const auto &force : record.reactions) add(line, force);
  return line += '\n';
}

void Monitors::put(const Table &table, const std::string &text, const char *mode) {
  int problem = 0;
  if (rank_ == 0) {
    if (table.file.empty()) {
      std::fputs(text.c_str(), stdout);
      problem = std::fflush(stdout) ? errno : 0;
    } else if (std::FILE *file = std::fopen(table.file.c_str(), mode)) {
      if (std::fputs(text.c_str(), file) < 0) problem = errno;
      if (std::fclose(file) != 0 && problem == 0) problem = errno;
    } else {
      problem = errno;
    }
  }
  MPI_Bcast(&problem, 1, MPI_INT, 0, comm_);
  if (problem) {
    fail("option %s: cannot write '%s': %s", table.option.c_str(), table.file.c_str(), std::strerror(problem));
  }
}

void Monitors::begin(PetscInt last_step) {
  for (const auto &table : tables_) {
    std::string text = header(table);
    if (last_step >= 0 && !table.file.empty() && rank_ == 0) {
      std::ifstream old(table.file);
      std::string row;
      std::getline(old, row);
      while (std::getline(old, row)) {
        if (std::atoll(row.c_str()) <= last_step) text.append(row).append("\n");
      }
    }
    put(table, text, "w");
  }
}

void Monitors::write(const Record &record) {
  for (const auto &table : tables_) put(table, line(table, record), "a");
}

}  // namespace hg
