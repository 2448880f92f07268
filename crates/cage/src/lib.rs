//! Control cages: reading OBJ and glTF, validation, topology.
