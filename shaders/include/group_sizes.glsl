// Of work groups. A software driver takes longer to begin a small group than to run it.
#ifdef WIDE_GROUPS
const uint kListGroup = 1024u;
#define PICTURE_GROUP local_size_x = 32, local_size_y = 32
#else
const uint kListGroup = 64u;
#define PICTURE_GROUP local_size_x = 8, local_size_y = 8
#endif
