// Refined positions by OpenSubdiv, for tests/golden/opensubdiv.json (opensubdiv.py beside this file says how).
//
// Reads one mesh from standard input: scheme (0 Catmull-Clark, 1 Loop), boundary (0 edge only, 1 edge and
// corner), levels; then the points, faces, creases and corners, each list preceded by its length.
// Writes, for every level from 1 on and for the limits of the last, the number of points and then the points,
// in hexadecimal floating point.

#include <cstdio>
#include <memory>
#include <vector>

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

using namespace OpenSubdiv;

struct Point {
    double x[3] = {0, 0, 0};
    void Clear(void * = nullptr) { x[0] = x[1] = x[2] = 0; }
    void AddWithWeight(Point const &p, double w) {
        for (int k = 0; k < 3; ++k) x[k] += w * p.x[k];
    }
};

template <class T> static T read(char const *format) {
    T value{};
    if (std::scanf(format, &value) != 1) std::exit(1);
    return value;
}
static int integer() { return read<int>("%d"); }
static double number() { return read<double>("%lf"); }

int main() {
    int scheme = integer(), boundary = integer(), levels = integer();

    std::vector<Point> points(integer());
    for (Point &p : points)
        for (double &x : p.x) x = number();

    std::vector<int> sizes(integer()), corners;
    for (int &size : sizes) {
        size = integer();
        for (int k = 0; k < size; ++k) corners.push_back(integer());
    }
    std::vector<int> creases, sharp;
    std::vector<float> crease_sharpness, sharpness;
    for (int n = integer(); n > 0; --n) {
        creases.push_back(integer());
        creases.push_back(integer());
        crease_sharpness.push_back(float(number()));
    }
    for (int n = integer(); n > 0; --n) {
        sharp.push_back(integer());
        sharpness.push_back(float(number()));
    }

    Far::TopologyDescriptor mesh;
    mesh.numVertices = int(points.size());
    mesh.numFaces = int(sizes.size());
    mesh.numVertsPerFace = sizes.data();
    mesh.vertIndicesPerFace = corners.data();
    mesh.numCreases = int(crease_sharpness.size());
    mesh.creaseVertexIndexPairs = creases.data();
    mesh.creaseWeights = crease_sharpness.data();
    mesh.numCorners = int(sharp.size());
    mesh.cornerVertexIndices = sharp.data();
    mesh.cornerWeights = sharpness.data();

    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(
        boundary ? Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER : Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    Sdc::SchemeType type = scheme ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(mesh, Factory::Options(type, options)));
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = true;  // limits need it
    refiner->RefineUniform(uniform);

    Far::PrimvarRefinerReal<double> refine(*refiner);
    std::vector<Point> from = points;
    for (int level = 1; level <= levels; ++level) {
        std::vector<Point> to(refiner->GetLevel(level).GetNumVertices());
        refine.Interpolate(level, from, to);
        std::printf("%zu\n", to.size());
        for (Point const &p : to) std::printf("%a %a %a\n", p.x[0], p.x[1], p.x[2]);
        from = to;
    }
    std::vector<Point> limits(from.size());
    refine.Limit(from, limits);
    std::printf("%zu\n", limits.size());
    for (Point const &p : limits) std::printf("%a %a %a\n", p.x[0], p.x[1], p.x[2]);
}
