#include "import.h"

#include <new>

#include "../error.h"
#include "accessor.h"
#include "animation.h"
#include "budget.h"
#include "document.h"
#include "extensions.h"
#include "geometry.h"
#include "materials.h"
#include "node_tree.h"
#include "notes.h"
#include "placed.h"
#include "rig.h"

namespace host::gltf {

namespace {

Level import_document(const Document& document, const std::string& name,
                      const std::string& animation, const NodeFilter& moved) {
    Level level;
    level.name = name;
    Notes notes;
    Budget budget(document.bytes_read);
    Accessors accessors(document);
    note_ignored(document.extensions, notes);
    const NodeTree tree = build_node_tree(document.model);
    RigBuilder rig(document.model, tree,
                   import_clips(document.model, animation, accessors, budget, notes), moved,
                   level.rig);
    import_geometry(document, tree, accessors, rig, budget, level, notes);
    import_materials(document, level, notes);
    import_placed(document.model, tree, rig, level, notes);
    level.notes = notes.take();
    return level;
}

// tinygltf and the JSON library throw exceptions of their own for some malformed files.
template <class Read>
Level import_named(const std::string& name, const std::string& animation, const NodeFilter& moved,
                   const Read& read) {
    const auto refuse = [&](const std::string& cause) {
        return InputError("the scene file " + name + " cannot be used: " + cause);
    };
    try {
        return import_document(read(), name, animation, moved);
    } catch (const InputError& error) {
        throw refuse(error.what());
    } catch (const std::bad_alloc&) {
        throw refuse("there is not enough memory for it");
    } catch (const std::exception& error) {
        throw refuse(std::string("it is malformed (") + error.what() + ")");
    }
}

} // namespace

Level import_file(const std::filesystem::path& path, const std::string& animation,
                  const NodeFilter& moved) {
    return import_named(path.string(), animation, moved, [&] { return read_document(path); });
}

Level import_bytes(const std::string& bytes, const std::string& name, const std::string& animation,
                   const NodeFilter& moved) {
    return import_named(name, animation, moved, [&] { return parse_document(bytes, {}); });
}

} // namespace host::gltf
