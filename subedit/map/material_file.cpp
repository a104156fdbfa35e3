#include "subedit/map/material_file.h"
