#include "renderer/gl/context.h"
