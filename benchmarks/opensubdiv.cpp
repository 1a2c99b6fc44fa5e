// OpenSubdiv as a peer: one thread, double precision, arrays in and arrays out.
//
//   opensubdiv MESH SCHEME LEVELS    SCHEME is catmull-clark or loop
//
// MESH is a binary file of int32 counts (vertices, faces, corners, creases), then points (float64, 3 a vertex), face
// sizes, corners and the ends of the creases (int32), and the sharpness of the creases (float32).
// Every line read from standard input is one run, answered by one line:
//
//   cold    seconds from these arrays to refined points and faces
//   warm    seconds from points to refined points, by a stencil table made once
//   save    nothing; writes the refined points to MESH.points (float64)
//   memory  bytes by which the peak of the process grew since it had read the mesh

#include <ctime>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/stencilTableFactory.h>
#include <opensubdiv/far/topologyDescriptor.h>

using namespace OpenSubdiv;

struct Point {
    double x[3];
    void Clear(void * = nullptr) { x[0] = x[1] = x[2] = 0; }
    void AddWithWeight(Point const &p, double w) {
        for (int k = 0; k < 3; ++k) x[k] += w * p.x[k];
    }
};

template <class T> static std::vector<T> read(std::FILE *file, size_t n) {
    std::vector<T> values(n);
    if (std::fread(values.data(), sizeof(T), n, file) != n) std::exit(1);
    return values;
}

static double seconds() {  // of the processor, so that others who use it do not count
    timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

static long peak() {  // not getrusage: that begins with the peak of the parent
    long kilobytes = 0;
    char line[128];
    std::FILE *file = std::fopen("/proc/self/status", "r");
    while (file && std::fgets(line, sizeof line, file))
        if (std::sscanf(line, "VmHWM: %ld", &kilobytes) == 1) break;
    if (file) std::fclose(file);
    return kilobytes * 1024;
}

struct Mesh {
    std::vector<Point> points;
    std::vector<int> sizes, corners, creases;
    std::vector<float> sharpness;
    Sdc::SchemeType scheme;
    int levels;

    std::unique_ptr<Far::TopologyRefiner> refined(bool whole) const {
        Far::TopologyDescriptor told;
        told.numVertices = int(points.size());
        told.numFaces = int(sizes.size());
        told.numVertsPerFace = sizes.data();
        told.vertIndicesPerFace = corners.data();
        told.numCreases = int(sharpness.size());
        told.creaseVertexIndexPairs = creases.data();
        told.creaseWeights = sharpness.data();
        Sdc::Options options;
        options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
        using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
        std::unique_ptr<Far::TopologyRefiner> refiner(Factory::Create(told, Factory::Options(scheme, options)));
        Far::TopologyRefiner::UniformOptions uniform(levels);
        uniform.fullTopologyInLastLevel = whole;
        refiner->RefineUniform(uniform);
        return refiner;
    }
};

struct Result {
    std::vector<Point> points;
    std::vector<int> faces;
};

static Result cold(Mesh const &mesh) {
    auto refiner = mesh.refined(false);
    Far::PrimvarRefinerReal<double> refine(*refiner);
    Result result;
    std::vector<Point> from;
    for (int level = 1; level <= mesh.levels; ++level) {
        result.points.resize(refiner->GetLevel(level).GetNumVertices());
        refine.Interpolate(level, level == 1 ? mesh.points : from, result.points);
        if (level < mesh.levels) from.swap(result.points);
    }
    auto const &last = refiner->GetLevel(mesh.levels);
    result.faces.reserve(last.GetNumFaceVertices());
    for (int f = 0; f < last.GetNumFaces(); ++f) {
        auto corners = last.GetFaceVertices(f);
        result.faces.insert(result.faces.end(), corners.begin(), corners.end());
    }
    return result;
}

static std::unique_ptr<Far::StencilTableReal<double> const> stencils(Mesh const &mesh) {
    auto refiner = mesh.refined(false);
    using Factory = Far::StencilTableFactoryReal<double>;
    Factory::Options options;
    options.generateIntermediateLevels = false;
    options.generateOffsets = true;
    return std::unique_ptr<Far::StencilTableReal<double> const>(Factory::Create(*refiner, options));
}

int main(int count, char **words) {
    if (count != 4) return 1;
    std::FILE *file = std::fopen(words[1], "rb");
    if (!file) return 1;
    Mesh mesh;
    auto counts = read<int>(file, 4);
    mesh.points = read<Point>(file, counts[0]);
    mesh.sizes = read<int>(file, counts[1]);
    mesh.corners = read<int>(file, counts[2]);
    mesh.creases = read<int>(file, 2 * counts[3]);
    mesh.sharpness = read<float>(file, counts[3]);
    std::fclose(file);
    mesh.scheme = std::string(words[2]) == "loop" ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
    mesh.levels = std::atoi(words[3]);

    long before = peak();
    std::unique_ptr<Far::StencilTableReal<double> const> table;
    std::vector<Point> target;
    char line[16];
    while (std::scanf("%15s", line) == 1) {
        if (!std::strcmp(line, "cold")) {
            double start = seconds();
            Result result = cold(mesh);
            std::printf("%.9f\n", seconds() - start);
        } else if (!std::strcmp(line, "warm")) {
            if (!table) table = stencils(mesh), target.resize(table->GetNumStencils());
            double start = seconds();
            table->UpdateValues(mesh.points, target);
            std::printf("%.9f\n", seconds() - start);
        } else if (!std::strcmp(line, "save")) {
            Result result = cold(mesh);
            std::FILE *out = std::fopen((std::string(words[1]) + ".points").c_str(), "wb");
            std::fwrite(result.points.data(), sizeof(Point), result.points.size(), out);
            std::fclose(out);
            std::printf("saved\n");
        } else {
            std::printf("%ld\n", peak() - before);
        }
        std::fflush(stdout);
    }
}
