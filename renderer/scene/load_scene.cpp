#include "renderer/scene/load_scene.h"
