// Asks Embree 3 and Embree 4 alike: each query of 3 takes a context, none of 4 does.
//
// CMakeLists.txt takes 4 where both are installed, as the header here does.
#ifndef LUXFIT_FORWARD_ROOM_INTERNAL_EMBREE_QUERIES_H_
#define LUXFIT_FORWARD_ROOM_INTERNAL_EMBREE_QUERIES_H_

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace luxfit {

#if RTC_VERSION_MAJOR >= 4
inline void Intersect(RTCScene scene, RTCRayHit& ray) { rtcIntersect1(scene, &ray); }
inline void Intersect(RTCScene scene, const int* valid, RTCRayHit8& rays) {
  rtcIntersect8(valid, scene, &rays);
}
inline void Occlude(RTCScene scene, RTCRay& ray) { rtcOccluded1(scene, &ray); }
inline void Occlude(RTCScene scene, const int* valid, RTCRay8& rays) { rtcOccluded8(valid, scene, &rays); }
#else
inline RTCIntersectContext NewContext() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  return context;
}
inline void Intersect(RTCScene scene, RTCRayHit& ray) {
  RTCIntersectContext context = NewContext();
  rtcIntersect1(scene, &context, &ray);
}
inline void Intersect(RTCScene scene, const int* valid, RTCRayHit8& rays) {
  RTCIntersectContext context = NewContext();
  rtcIntersect8(valid, scene, &context, &rays);
}
inline void Occlude(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context = NewContext();
  rtcOccluded1(scene, &context, &ray);
}
inline void Occlude(RTCScene scene, const int* valid, RTCRay8& rays) {
  RTCIntersectContext context = NewContext();
  rtcOccluded8(valid, scene, &context, &rays);
}
#endif

}  // namespace luxfit

#endif  // LUXFIT_FORWARD_ROOM_INTERNAL_EMBREE_QUERIES_H_
