// The formats that joints are imported from. Every reader converts the coordinates of its file to m, adds `shift` (m)
// and throws FileFault.
#pragma once

#include <string_view>

#include "app/import/imported.hpp"

namespace voussoir {

// CloudCompare's table of facets (plugin qFacets): semicolons, one facet a row. Centres and polygons are local; global
// centres, of which the file keeps six digits, give the shift between the two. Without a PolygonZ a facet is the
// ellipse of its two extensions.
ImportedJoints read_facets(std::string_view text, const Vector<3>& shift);

// FracMan's fractures in ASCII (.fab): section FRACTURE; tessellated ones are dropped.
ImportedJoints read_fab(std::string_view text, const Vector<3>& shift);

// ASCII DXF: 3DFACE and closed POLYLINE and LWPOLYLINE of the section ENTITIES that the drawing shows in its model;
// arcs are chords, the layer is the set.
ImportedJoints read_dxf(std::string_view text, const Vector<3>& shift);

// GeoJSON in a plane: every segment of a LineString or MultiLineString is a trace. The property `set` names its set.
ImportedJoints read_traces(std::string_view text, const Vector<3>& shift);

}  // namespace voussoir
