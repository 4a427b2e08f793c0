// SPDX-License-Identifier: MIT
// VTK XML files for ParaView: the surface of revolution with the fields on it, and the flow in a plane through the
// axis. The axis is VTK's z.
#pragma once

#include "atomic_file.hpp"
#include "csv.hpp"
#include "flow_field.hpp"

#include <cmath>
#include <string>
#include <vector>

namespace axistokes {

namespace detail {

inline void write_vtk_header(std::ostream& out, const char* type) {
    // ASCII numbers: the byte order is a formality of the format.
    out << "<?xml version=\"1.0\"?>\n<VTKFile type=\"" << type << "\" version=\"0.1\" byte_order=\"LittleEndian\">\n";
}

/// A DataArray of `count` tuples; value(tuple, component).
template <class Value>
void write_data_array(std::ostream& out, const char* type, const std::string& name, int components, Index count,
                      const Value& value) {
    out << "<DataArray type=\"" << type << "\" Name=\"" << name << "\" NumberOfComponents=\"" << components
        << "\" format=\"ascii\">\n";
    for (Index i = 0; i < count; ++i) {
        for (int c = 0; c < components; ++c) {
            out << value(i, c) << (c + 1 < components ? ' ' : '\n');
        }
    }
    out << "</DataArray>\n";
}

/// The surface of revolution as points and polygons: a node off the axis becomes a ring of `sectors` points.
class RevolvedMesh {
  public:
    RevolvedMesh(Index nodes, Index sectors) : nodes_(nodes), sectors_(sectors) {}

    Index points() const { return 2 + (nodes_ - 2) * sectors_; }
    Index polygons() const { return (nodes_ - 1) * sectors_; }

    Index node(Index point) const {
        return point == 0 ? 0 : point == points() - 1 ? nodes_ - 1 : 1 + (point - 1) / sectors_;
    }
    double angle(Index point) const {
        const double turn = static_cast<double>((point + sectors_ - 1) % sectors_) / static_cast<double>(sectors_);
        return 2 * pi_value<double>() * turn;
    }
    /// Corners of a polygon, counter-clockwise seen from outside: triangles at the poles, quadrilaterals elsewhere.
    std::vector<Index> corners(Index polygon) const {
        const Index element = polygon / sectors_;
        const Index here = polygon % sectors_;
        const Index next = (here + 1) % sectors_;
        const auto point = [&](Index node, Index sector) { return 1 + (node - 1) * sectors_ + sector; };
        if (element == 0) {
            return {0, point(1, next), point(1, here)};
        }
        if (element == nodes_ - 2) {
            return {point(element, here), point(element, next), points() - 1};
        }
        return {point(element, here), point(element, next), point(element + 1, next), point(element + 1, here)};
    }

  private:
    Index nodes_;
    Index sectors_;
};

}  // namespace detail

/// Surface of revolution as VTK PolyData (.vtp). Point data are the columns of shape_columns: pairs x_r, x_z become
/// vectors x. Throws InvalidArgument for fewer than 3 sectors and OutputError.
template <class S>
void write_vtk_surface(const std::filesystem::path& path, const std::vector<Column<S>>& columns, Index sectors = 64) {
    detail::require(sectors >= 3, "number of sectors", sectors, "at least 3");
    const auto find = [&](const std::string& name) {
        for (const Column<S>& column : columns) {
            if (column.name == name) {
                return &column.values;
            }
        }
        throw InvalidArgument("VTK surface: no column '" + name + "'");
    };
    const Vector<S>& r = *find("r");
    const Vector<S>& z = *find("z");
    const detail::RevolvedMesh mesh(r.size(), sectors);
    const auto revolve = [&](const Vector<S>& radial, const Vector<S>& axial) {
        return [&](Index point, int component) {
            const Index i = mesh.node(point);
            const double a = mesh.angle(point);
            return component == 2 ? axial[i] : S(radial[i] * S(component == 0 ? std::cos(a) : std::sin(a)));
        };
    };
    write_atomically(path, [&](std::ostream& out) {
        detail::write_vtk_header(out, "PolyData");
        out << "<PolyData>\n<Piece NumberOfPoints=\"" << mesh.points() << "\" NumberOfPolys=\"" << mesh.polygons()
            << "\">\n<PointData>\n";
        for (const Column<S>& column : columns) {
            const std::string& name = column.name;
            if (name == "r" || name == "z" || name.ends_with("_z")) {
                continue;
            }
            if (name.ends_with("_r")) {
                const std::string stem = name.substr(0, name.size() - 2);
                detail::write_data_array(out, "Float64", stem, 3, mesh.points(),
                                         revolve(column.values, *find(stem + "_z")));
            } else {
                detail::write_data_array(out, "Float64", name, 1, mesh.points(),
                                         [&](Index point, int) { return column.values[mesh.node(point)]; });
            }
        }
        out << "</PointData>\n<Points>\n";
        detail::write_data_array(out, "Float64", "Points", 3, mesh.points(), revolve(r, z));
        out << "</Points>\n<Polys>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n";
        std::vector<Index> offsets;
        Index offset = 0;
        for (Index p = 0; p < mesh.polygons(); ++p) {
            for (const Index corner : mesh.corners(p)) {
                out << corner << ' ';
                ++offset;
            }
            out << '\n';
            offsets.push_back(offset);
        }
        out << "</DataArray>\n";
        detail::write_data_array(out, "Int64", "offsets", 1, mesh.polygons(),
                                 [&](Index p, int) { return offsets[static_cast<std::size_t>(p)]; });
        out << "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
    });
}

/// Flow field as a VTK StructuredGrid (.vts) in the plane y = 0, both sides of the axis: `velocity` in the laboratory
/// frame, `relative_velocity` in that of a centroid moving with `centroid_velocity`, and `inside`.
template <class S>
void write_vtk_flow(const std::filesystem::path& path, const FlowField<S>& field, const S& centroid_velocity) {
    const Index half = field.grid.columns;
    const Index width = 2 * half - 1;
    const Index count = width * field.grid.rows;
    const auto source = [&](Index point) { return point / width * half + std::abs(point % width - (half - 1)); };
    const auto side = [&](Index point) { return S(point % width < half - 1 ? -1 : 1); };
    const auto velocity = [&](const S& frame) {
        return [&, frame](Index point, int component) {
            const Index i = source(point);
            return component == 0   ? S(side(point) * field.velocity_r[i])
                   : component == 1 ? S(0)
                                    : S(field.velocity_z[i] - frame);
        };
    };
    write_atomically(path, [&](std::ostream& out) {
        detail::write_vtk_header(out, "StructuredGrid");
        std::ostringstream extent;
        extent << "0 " << width - 1 << " 0 0 0 " << field.grid.rows - 1;
        out << "<StructuredGrid WholeExtent=\"" << extent.str() << "\">\n<Piece Extent=\"" << extent.str()
            << "\">\n<PointData Vectors=\"velocity\">\n";
        detail::write_data_array(out, "Float64", "velocity", 3, count, velocity(S(0)));
        detail::write_data_array(out, "Float64", "relative_velocity", 3, count, velocity(centroid_velocity));
        detail::write_data_array(out, "Int32", "inside", 1, count, [&](Index point, int) {
            return static_cast<int>(field.inside[static_cast<std::size_t>(source(point))]);
        });
        out << "</PointData>\n<Points>\n";
        detail::write_data_array(out, "Float64", "Points", 3, count, [&](Index point, int component) {
            const Index i = source(point);
            return component == 0 ? S(side(point) * field.points.r[i]) : component == 1 ? S(0) : field.points.z[i];
        });
        out << "</Points>\n</Piece>\n</StructuredGrid>\n</VTKFile>\n";
    });
}

}  // namespace axistokes
