#include "query/chosen.h"

#include "scene/alpha_test.h"

#include <algorithm>

namespace peregrine::query {
namespace {

bool is_there(const scene::Snapshot& snapshot, const base::Handle& mesh) {
    return mesh && mesh.index < snapshot.meshes.size()
           && snapshot.meshes[mesh.index].generation == mesh.generation;
}

} // namespace

trace::Filter filter_of(const scene::Snapshot& snapshot, const Selection& selection) {
    trace::Filter filter;
    filter.faces = selection.faces;
    filter.layer_mask = selection.layer_mask;
    filter.layer_masks = snapshot.layer_masks.data();
    if (is_there(snapshot, selection.ignore_mesh)) filter.ignore_mesh = selection.ignore_mesh.index;
    if (selection.alpha_test && (snapshot.features & scene::kAlphaMask))
        filter.alpha = scene::alpha_test(snapshot);
    return filter;
}

Chosen::Chosen(const scene::Snapshot& snapshot, const Selection& selection)
    : filter_(filter_of(snapshot, selection)), longer_(snapshot.meshes.get_allocator()) {
    if (!selection.ignore_meshes.empty()) ignore(snapshot, selection.ignore_meshes);
}

void Chosen::ignore(const scene::Snapshot& snapshot, std::span<const base::Handle> meshes) {
    if (meshes.size() > kRoom) longer_.resize(meshes.size());
    uint32_t* const first = meshes.size() > kRoom ? longer_.data() : room_.data();
    uint32_t* last = first;
    for (const base::Handle& mesh : meshes)
        if (is_there(snapshot, mesh)) *last++ = mesh.index;
    std::sort(first, last);
    if (filter_.ignore_mesh == geometry::kNoTriangle && first != last)
        filter_.ignore_mesh = *--last;
    filter_.ignore_more = {first, last};
}

} // namespace peregrine::query
