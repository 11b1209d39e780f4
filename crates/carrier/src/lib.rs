//! OBJ, glTF, images and layers to and from plants; assembling
