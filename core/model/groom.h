// SPDX-License-Identifier: Apache-2.0
// The Groom: everything that the artist made, as one value.
#pragma once

#include "core/base/cow.h"
#include "core/model/field_stroke.h"
#include "core/model/guide_set.h"
#include "core/model/hair_params.h"
#include "core/model/lic_params.h"
#include "core/model/map.h"
#include "core/model/parting.h"
#include "core/model/surface_mesh.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace whorl {

/// Guides and hairs that share parameters. The number of a group is its place in Groom::groups.
struct Group {
    std::string name;  ///< unique in the groom; letters, digits, '_' and '-'
    HairParams params{};
    bool operator==(const Group&) const = default;
};

/// A groom is a value: copying it is cheap (parts are shared until edited), two copies never see each other's edits.
/// core turns one Groom into another or into hair; the editor keeps its history as Grooms.
struct Groom {
    static constexpr std::size_t maxGroups = 30;

    Cow<SurfaceMesh> mesh;
    Cow<std::vector<PartSettings>> partSettings;  ///< as many as mesh->parts
    GuideSet guides;
    MapSet maps;
    Cow<std::vector<Group>> groups{{Group{"hair"}}};  ///< 1 to maxGroups
    Cow<CountParams> counts;
    Cow<std::vector<Parting>> partings;     ///< at most Parting::maxPartings
    Cow<std::vector<FieldStroke>> strokes;  ///< at most FieldStroke::maxStrokes
    Cow<FieldParams> field;
    Cow<LicParams> lic;

    /// The blocks of the whole groom: calls visit(BlockInfo, Cow of the block).
    template <class Self, class Visit>
    static void eachBlock(Self& self, Visit&& visit) {
        visit(BlockInfo{"counts", "Counts", "How many of everything, for the whole groom."}, self.counts);
        visit(BlockInfo{"field", "Field", "Which way hair lies on the skin, spread from strokes, and guides along it."},
              self.field);
        visit(BlockInfo{"lic", "Hair texture", "Hair painted on the skin along the field: short coats and undercoats."},
              self.lic);
    }

    /// True when every part is shared with `other`: nothing can differ.
    bool sameAs(const Groom& other) const;
    /// Memory that keeping this beside `before` costs.
    std::size_t bytesNotSharedWith(const Groom& before) const;
    /// Number of the group of that name, or -1.
    int groupIndex(std::string_view name) const;
    bool growsHair(std::uint32_t part) const;
    /// The number of hairs stands for the density of today again (see CountParams::densityTotal).
    void countAnew();
    /// That many hairs, as the density of today has them.
    void setHairs(std::uint32_t hairs);
    /// Field and hair texture with the defaults of the mesh.
    void setDefaults();
};

/// A new groom on `mesh`: all parts grow hair, one group named "hair", no guides. Thicknesses and noise fit a head of a
/// third of a metre; for larger and smaller meshes they are scaled, because many files are in decimetres or centimetres
/// and hair of a tenth of a millimetre would not be seen on them.
Groom makeGroom(SurfaceMesh mesh);

/// Defaults for `mesh`, whose size their lengths follow as those of makeGroom do.
FieldParams fieldParamsFor(const SurfaceMesh& mesh);
LicParams licParamsFor(const SurfaceMesh& mesh);

/// What default lengths are multiplied by on `mesh`: 1 for a mesh from 0.1 to 0.6 m, else its size over 0.35 m.
float lengthScale(const SurfaceMesh& mesh);

/// What an opened file or an edit did not do quite as asked, one sentence each, for the artist.
using Problems = std::vector<std::string>;

/// Checks the laws of a groom (parts match, roots on the mesh, finite points, vertex counts, maps exist). Empty when
/// all hold. For tests, loaders and `whorl-cli info`.
Problems checkGroom(const Groom& groom);

}  // namespace whorl
