// SPDX-License-Identifier: Apache-2.0
#include "resources/samples/source/block_matrix.h"
#include "resources/samples/source/unwrap.h"

#include <glm/gtc/constants.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace whorl::samples {

using glm::dmat2;
using glm::dvec2;
using glm::dvec3;

namespace {

class Flattener {
public:
    Flattener(const HalfMesh& mesh, Chart& chart)
        : m_chart(chart),
          m_matrix(chart.meshVertex.size(), chart.triangles),
          m_free(chart.meshVertex.size(), dvec2(1)) {
        for (const auto& t : chart.triangles) {
            const dvec3 a(mesh.positions[chart.meshVertex[t[0]]]);
            const dvec3 b(mesh.positions[chart.meshVertex[t[1]]]);
            const dvec3 c(mesh.positions[chart.meshVertex[t[2]]]);
            const double along = glm::length(b - a);
            const dvec3 u = (b - a) / along;
            const double cx = glm::dot(c - a, u);
            const double cy = glm::length(glm::cross(b - a, c - a)) / along;
            // Gradients of the three hat functions in the triangle's own plane.
            Rest r;
            r.area = 0.5 * along * cy;
            r.grad[1] = dvec2(1.0 / along, -cx / (along * cy));
            r.grad[2] = dvec2(0.0, 1.0 / cy);
            r.grad[0] = -r.grad[1] - r.grad[2];
            m_area += r.area;
            m_rest.push_back(r);
        }
        m_position = [&mesh, &chart](uint32_t v) { return dvec3(mesh.positions[chart.meshVertex[v]]); };
    }

    void run() {
        tutte();
        for (size_t v = 0; v < m_free.size(); ++v) {
            m_free[v] = m_chart.onAxis[v] ? dvec2(0, 1) : dvec2(1);
        }
        double before = energy(m_chart.uvs);
        for (int i = 0; i < 60; ++i) {
            step(before);
            const double now = energy(m_chart.uvs);
            const bool settled = before - now < 1e-4 * now;
            before = now;
            if (settled) {
                break;
            }
        }
    }

private:
    struct Rest {
        double area;
        std::array<dvec2, 3> grad;
    };

    std::vector<uint32_t> border() const {
        std::vector<uint32_t> next(m_chart.meshVertex.size(), ~0u);
        size_t count = 0;
        uint32_t start = ~0u;
        for (const MeshEdge& e : collectEdges(m_chart.triangles)) {
            if (e.right >= 0) {
                continue;
            }
            const auto& t = m_chart.triangles[size_t(e.left)];
            const bool forward =
                (t[0] == e.a && t[1] == e.b) || (t[1] == e.a && t[2] == e.b) || (t[2] == e.a && t[0] == e.b);
            next[forward ? e.a : e.b] = forward ? e.b : e.a;
            start = std::min(start, e.a);
            ++count;
        }
        std::vector<uint32_t> loop;
        if (count > 0) {
            // A joined chart starts where its axis ends, so that the axis is one run at the end of the loop.
            for (uint32_t v = 0; v < next.size(); ++v) {
                if (next[v] != ~0u && m_chart.onAxis[v] && !m_chart.onAxis[next[v]]) {
                    start = v;
                    break;
                }
            }
            uint32_t v = start;
            do {
                loop.push_back(v);
                v = next[v];
            } while (v != start && v != ~0u && loop.size() <= count);
        }
        if (loop.size() != count || count < 3) {
            throw std::logic_error("chart is not a disc: border " + std::to_string(loop.size()) + " of " +
                                   std::to_string(count));
        }
        return loop;
    }

    /// Fold-free start: border on a (half) circle, everything else at the average of its neighbours.
    void tutte() {
        const std::vector<uint32_t> loop = border();
        std::vector<double> run(loop.size() + 1, 0.0);
        for (size_t i = 0; i < loop.size(); ++i) {
            run[i + 1] = run[i] + glm::distance(m_position(loop[i]), m_position(loop[(i + 1) % loop.size()]));
        }
        m_chart.uvs.assign(m_chart.meshVertex.size(), dvec2(0.0));
        const double pi = glm::pi<double>();
        size_t arcEnd = loop.size();
        if (m_chart.joined) {
            arcEnd = 1;
            while (!m_chart.onAxis[loop[arcEnd]]) {
                ++arcEnd;
            }
        }
        const double radius = std::sqrt((m_chart.joined ? 2.0 : 1.0) * m_area / pi);
        for (size_t i = 0; i < loop.size(); ++i) {
            dvec2 at;
            if (!m_chart.joined) {
                const double angle = 2.0 * pi * run[i] / run.back();
                at = dvec2(std::cos(angle), std::sin(angle));
            } else if (i <= arcEnd) {
                const double angle = pi * (run[i] / run[arcEnd] - 0.5);
                at = i == 0 ? dvec2(0, -1) : i == arcEnd ? dvec2(0, 1) : dvec2(std::cos(angle), std::sin(angle));
            } else {
                at = dvec2(0.0, 1.0 - 2.0 * (run[i] - run[arcEnd]) / (run.back() - run[arcEnd]));
            }
            m_chart.uvs[loop[i]] = at * radius;
            m_free[loop[i]] = dvec2(0.0);
        }
        m_matrix.clear();
        for (const auto& t : m_chart.triangles) {
            for (int c = 0; c < 3; ++c) {
                const uint32_t a = t[c], b = t[(c + 1) % 3];
                m_matrix.at(a, a) += dvec3(1, 0, 1);
                m_matrix.at(b, b) += dvec3(1, 0, 1);
                m_matrix.at(a, b) -= dvec3(1, 0, 1);
                m_matrix.at(b, a) -= dvec3(1, 0, 1);
            }
        }
        solve(std::vector<dvec2>(m_free.size(), dvec2(0.0)), m_chart.uvs, 2000, 1e-10);
    }

    /// Conjugate gradients on the free coordinates, from the given start.
    void solve(const std::vector<dvec2>& rhs, std::vector<dvec2>& x, int limit, double tolerance) {
        const size_t n = x.size();
        std::vector<dvec2> r(n), z(n), p(n), ap(n), inverse(n);
        for (uint32_t v = 0; v < n; ++v) {
            const dvec3 d = m_matrix.at(v, v);
            inverse[v] = dvec2(1.0 / d.x, 1.0 / d.z);
        }
        m_matrix.multiply(x, ap);
        double rz = 0.0;
        for (size_t v = 0; v < n; ++v) {
            r[v] = (rhs[v] - ap[v]) * m_free[v];
            p[v] = z[v] = r[v] * inverse[v];
            rz += glm::dot(r[v], z[v]);
        }
        const double goal = rz * tolerance * tolerance;
        for (int i = 0; i < limit && rz > goal && rz > 1e-300; ++i) {
            m_matrix.multiply(p, ap);
            double pap = 0.0;
            for (size_t v = 0; v < n; ++v) {
                ap[v] *= m_free[v];
                pap += glm::dot(p[v], ap[v]);
            }
            const double alpha = rz / pap;
            double rzNew = 0.0;
            for (size_t v = 0; v < n; ++v) {
                x[v] += p[v] * alpha;
                r[v] -= ap[v] * alpha;
                z[v] = r[v] * inverse[v];
                rzNew += glm::dot(r[v], z[v]);
            }
            const double beta = rzNew / rz;
            rz = rzNew;
            for (size_t v = 0; v < n; ++v) {
                p[v] = z[v] + p[v] * beta;
            }
        }
    }

    dmat2 jacobian(size_t t, const std::vector<dvec2>& w) const {
        const auto& tri = m_chart.triangles[t];
        dmat2 j(0.0);
        for (int c = 0; c < 3; ++c) {
            j[0] += w[tri[c]] * m_rest[t].grad[c].x;
            j[1] += w[tri[c]] * m_rest[t].grad[c].y;
        }
        return j;
    }

    /// Symmetric Dirichlet energy: grows without bound as a triangle collapses, least when lengths are kept.
    double energy(const std::vector<dvec2>& w) const {
        double sum = 0.0;
        for (size_t t = 0; t < m_rest.size(); ++t) {
            const dmat2 j = jacobian(t, w);
            const double det = glm::determinant(j);
            if (det <= 0.0) {
                return 1e300;
            }
            const double square = glm::dot(j[0], j[0]) + glm::dot(j[1], j[1]);
            sum += m_rest[t].area * square * (1.0 + 1.0 / (det * det));
        }
        return sum / m_area;
    }

    /// One reweighted least-squares step (scalable locally injective mappings) with a line search.
    void step(double current) {
        m_matrix.clear();
        std::vector<dvec2> rhs(m_free.size(), dvec2(0.0));
        for (size_t t = 0; t < m_rest.size(); ++t) {
            const dmat2 j = jacobian(t, m_chart.uvs);
            // Polar form of the Jacobian: rotation times a symmetric stretch with singular values s0 >= s1.
            const double e = 0.5 * (j[0][0] + j[1][1]), f = 0.5 * (j[0][0] - j[1][1]);
            const double g = 0.5 * (j[0][1] + j[1][0]), h = 0.5 * (j[0][1] - j[1][0]);
            const double q = std::hypot(e, h), r = std::hypot(f, g);
            const double s0 = q + r, s1 = std::max(q - r, 1e-12);
            const double a1 = std::atan2(g, f), a2 = std::atan2(h, e);
            const double phi = 0.5 * (a2 + a1);  // angle of the left singular vector
            auto weight = [](double s) { return std::abs(s - 1.0) < 1e-4 ? 4.0 : (s - 1.0 / (s * s * s)) / (s - 1.0); };
            const double w0 = weight(s0), w1 = weight(s1), cp = std::cos(phi), sp = std::sin(phi);
            const dvec3 m(w0 * cp * cp + w1 * sp * sp, (w0 - w1) * cp * sp, w0 * sp * sp + w1 * cp * cp);
            const dmat2 rotation(std::cos(a2), std::sin(a2), -std::sin(a2), std::cos(a2));
            const auto& tri = m_chart.triangles[t];
            const Rest& rest = m_rest[t];
            for (int k = 0; k < 3; ++k) {
                rhs[tri[k]] += rest.area * BlockMatrix::apply(m, rotation * rest.grad[k]);
                for (int l = 0; l < 3; ++l) {
                    m_matrix.at(tri[k], tri[l]) += m * (rest.area * glm::dot(rest.grad[k], rest.grad[l]));
                }
            }
        }
        std::vector<dvec2> goal = m_chart.uvs;
        solve(rhs, goal, 150, 1e-3);
        double length = 1.0;
        std::vector<dvec2> move(goal.size());
        for (size_t v = 0; v < goal.size(); ++v) {
            move[v] = goal[v] - m_chart.uvs[v];
        }
        for (size_t t = 0; t < m_rest.size(); ++t) {
            length = std::min(length, 0.9 * timeToFold(jacobian(t, m_chart.uvs), jacobian(t, move)));
        }
        for (int i = 0; i < 20; ++i, length *= 0.6) {
            for (size_t v = 0; v < goal.size(); ++v) {
                goal[v] = m_chart.uvs[v] + move[v] * length;
            }
            if (energy(goal) < current) {
                m_chart.uvs = goal;
                return;
            }
        }
    }

    /// Smallest positive t at which det(j + t d) is zero.
    static double timeToFold(const dmat2& j, const dmat2& d) {
        const double a = glm::determinant(d);
        const double b = j[0][0] * d[1][1] + d[0][0] * j[1][1] - j[0][1] * d[1][0] - d[0][1] * j[1][0];
        const double c = glm::determinant(j);
        const double root = b * b - 4.0 * a * c;
        if (root < 0.0) {
            return 1e9;
        }
        // The stable form of the quadratic formula; c is positive.
        const double q = -0.5 * (b + std::copysign(std::sqrt(root), b));
        double best = 1e9;
        for (const double t : {a != 0.0 ? q / a : -1.0, q != 0.0 ? c / q : -1.0}) {
            if (t > 0.0) {
                best = std::min(best, t);
            }
        }
        return best;
    }

    Chart& m_chart;
    BlockMatrix m_matrix;
    std::vector<dvec2> m_free;
    std::vector<Rest> m_rest;
    double m_area = 0.0;
    std::function<dvec3(uint32_t)> m_position;
};

}  // namespace

void flatten(const HalfMesh& mesh, Chart& chart) {
    Flattener(mesh, chart).run();
}

}  // namespace whorl::samples
