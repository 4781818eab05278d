//! The CAM of a vehicle (EN 302 637-2, `spec/6-link.md#cam`).

use c_its_parser::standards::cam_1_4_1::cam_pdu_descriptions::{
    BasicContainer, BasicVehicleContainerHighFrequency, CAM, CamParameters, CoopAwareness,
    GenerationDeltaTime, HighFrequencyContainer,
};
use c_its_parser::standards::cdd_1_3_1_1::its_container::{
    AccelerationConfidence, Curvature, CurvatureCalculationMode, CurvatureConfidence,
    CurvatureValue, DriveDirection, LongitudinalAcceleration, LongitudinalAccelerationValue,
    YawRate, YawRateConfidence, YawRateValue,
};

use super::asn1::{CentreOffset, Etsi, State};
use super::bytes;
use super::error::{DecodeError, EncodeError, Pdu, Place};
use super::header::{self, PASSENGER_CAR};
use super::vehicle::Vehicle;

/// The state of a vehicle whose pose is valid for this generation delta time.
pub(super) fn write(sender: u32, time: u16, vehicle: Vehicle) -> Result<State, EncodeError> {
    let Vehicle { reference, heading, speed, length, width, centre_offset } = vehicle;
    let fast = BasicVehicleContainerHighFrequency {
        heading,
        speed,
        drive_direction: DriveDirection::forward,
        vehicle_length: length,
        vehicle_width: width,
        longitudinal_acceleration: LongitudinalAcceleration {
            longitudinal_acceleration_value: LongitudinalAccelerationValue(161),
            longitudinal_acceleration_confidence: AccelerationConfidence(102),
        },
        curvature: Curvature::new(CurvatureValue(1023), CurvatureConfidence::unavailable),
        curvature_calculation_mode: CurvatureCalculationMode::unavailable,
        yaw_rate: YawRate::new(YawRateValue(32_767), YawRateConfidence::unavailable),
        acceleration_control: None,
        lane_position: None,
        steering_wheel_angle: None,
        lateral_acceleration: None,
        vertical_acceleration: None,
        performance_class: None,
        cen_dsrc_tolling_zone: None,
    };
    let parameters = CamParameters::new(
        BasicContainer::new(PASSENGER_CAR, reference),
        HighFrequencyContainer::basicVehicleContainerHighFrequency(fast),
        None,
        None,
    );
    let cam = CAM {
        header: header::of(Pdu::Cam, sender),
        cam: CoopAwareness::new(GenerationDeltaTime(time), parameters),
    };
    Ok(State { centre_offset, cam: Etsi(bytes::encode(&cam)?.into()) })
}

/// The generation delta time of a CAM, and its vehicle.
pub(super) fn read(sender: u32, state: &State) -> Result<(u16, Vehicle), DecodeError> {
    let State { centre_offset: CentreOffset(centre_offset), cam: Etsi(cam) } = state;
    let CAM { header, cam } = bytes::decode(Pdu::Cam, cam)?;
    header::check(Pdu::Cam, sender, &header)?;
    let CamParameters { basic_container, high_frequency_container, .. } = cam.cam_parameters;
    let place = |field| Place::of("highFrequencyContainer", field);
    let HighFrequencyContainer::basicVehicleContainerHighFrequency(fast) = high_frequency_container
    else {
        return Err(DecodeError::Missing(place("basicVehicleContainerHighFrequency")));
    };
    if fast.drive_direction == DriveDirection::backward {
        return Err(DecodeError::Unsupported(place("driveDirection")));
    }
    let vehicle = Vehicle {
        reference: basic_container.reference_position,
        heading: fast.heading,
        speed: fast.speed,
        length: fast.vehicle_length,
        width: fast.vehicle_width,
        centre_offset: CentreOffset(*centre_offset),
    };
    Ok((cam.generation_delta_time.0, vehicle))
}
