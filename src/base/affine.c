#include "base/affine.h"

#include "base/elementary.h"

const affine AFFINE_IDENTITY = {{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}}};

affine affine_columns(vec3 x, vec3 y, vec3 z, vec3 origin) {
    return (affine){{{x.x, y.x, z.x, origin.x}, {x.y, y.y, z.y, origin.y}, {x.z, y.z, z.z, origin.z}}};
}

affine affine_translate(vec3 by) {
    return affine_columns((vec3){1, 0, 0}, (vec3){0, 1, 0}, (vec3){0, 0, 1}, by);
}

affine affine_scale(vec3 by) {
    return affine_columns((vec3){by.x, 0, 0}, (vec3){0, by.y, 0}, (vec3){0, 0, by.z}, (vec3){0, 0, 0});
}

/* Rodrigues' formula, column by column. */
affine affine_rotate(vec3 axis, double angle_deg) {
    const vec3 n = vec3_normalize(axis);
    const double c = elementary_cos_deg(angle_deg), s = elementary_sin_deg(angle_deg), k = 1.0 - c;
    const vec3 x = {c + n.x * n.x * k, n.x * n.y * k + n.z * s, n.x * n.z * k - n.y * s};
    const vec3 y = {n.x * n.y * k - n.z * s, c + n.y * n.y * k, n.y * n.z * k + n.x * s};
    const vec3 z = {n.x * n.z * k + n.y * s, n.y * n.z * k - n.x * s, c + n.z * n.z * k};
    return affine_columns(x, y, z, (vec3){0, 0, 0});
}

affine affine_compose(affine then, affine first) {
    return affine_columns(
        affine_direction(&then, affine_column(first, 0)), affine_direction(&then, affine_column(first, 1)),
        affine_direction(&then, affine_column(first, 2)), affine_point(&then, affine_column(first, 3)));
}

bool affine_is_finite(affine map) {
    return vec3_is_finite(affine_column(map, 0)) && vec3_is_finite(affine_column(map, 1)) &&
           vec3_is_finite(affine_column(map, 2)) && vec3_is_finite(affine_column(map, 3));
}

/* By Cramer's rule on columns brought to length one, so that scenes of any size are treated alike. */
bool affine_invert(affine map, affine *inverse) {
    const double least = 1e-100, most = 1e100, flat = 1e-12;
    vec3 axis[3];
    double length[3];
    for (int i = 0; i < 3; i++) {
        length[i] = vec3_length(affine_column(map, i));
        if (!(length[i] > least && length[i] < most)) return false;
        axis[i] = vec3_scale(affine_column(map, i), 1.0 / length[i]);
    }
    const vec3 origin = affine_column(map, 3);
    const double det = vec3_dot(axis[0], vec3_cross(axis[1], axis[2]));
    if (!(fabs(det) > flat) || !vec3_is_finite(origin) || !(vec3_max_abs(origin) < most)) return false;

    affine out;
    for (int i = 0; i < 3; i++) {
        const vec3 row =
            vec3_scale(vec3_cross(axis[(i + 1) % 3], axis[(i + 2) % 3]), 1.0 / (det * length[i]));
        out.m[i][0] = row.x;
        out.m[i][1] = row.y;
        out.m[i][2] = row.z;
        out.m[i][3] = -vec3_dot(row, origin);
    }
    *inverse = out;
    return true;
}

bool affine_is_similarity(affine map, double *factor) {
    const double tolerance = 1e-12;
    const vec3 x = affine_column(map, 0), y = affine_column(map, 1), z = affine_column(map, 2);
    const double length = vec3_length(x);
    const double near = tolerance * length, right = tolerance * length * length;
    if (!(length > 0.0 && fabs(vec3_length(y) - length) <= near && fabs(vec3_length(z) - length) <= near))
        return false;
    if (!(fabs(vec3_dot(x, y)) <= right && fabs(vec3_dot(y, z)) <= right && fabs(vec3_dot(z, x)) <= right))
        return false;
    *factor = length;
    return true;
}
