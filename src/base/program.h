/* Which program this is. */
#ifndef MONGE_BASE_PROGRAM_H
#define MONGE_BASE_PROGRAM_H

/* A hash of the sources that the program was built from, 32 hexadecimal digits; made by the build. */
extern const char program_hash[];

#endif
